// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/sim_node.hpp"

#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "common/bus/channels.hpp"
#include "common/bus/memory_bus.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/navigation.hpp"
#include "common/messages/sensing.hpp"
#include "common/messages/sim.hpp"
#include "tests/support/worlds/box_tunnel.hpp"

namespace adit {
namespace {

constexpr std::int64_t kStart = 1'600'000'000'000'000;
constexpr double kSpeed = 0.4;

class SimNodeTest : public testing::Test {
 protected:
  SimNodeTest() {
    bus_.tap([this](const ReceivedMessage& message) {
      ++counts_[std::string(message.channel)];
      EXPECT_EQ(message.utime, bus_.now_utime());
    });
  }

  void run(double seconds) {
    const std::int64_t end = node_.simulation().utime() + std::llround(seconds * 1e6);
    while (node_.simulation().utime() < end) {
      bus_.advance_to(node_.next_utime());
      node_.step();
    }
  }

  /// Publishes commands 20 times a second.
  void drive(double speed_m_s) {
    bus_.create_timer(50'000, [this, speed_m_s](std::int64_t utime) {
      publish(bus_, channels::kDriveCommand, to_message(DriveCommand{utime, speed_m_s, 0.0}));
    });
  }

  template <class Msg, class Value>
  void store(std::string_view channel, Value& newest) {
    subscribe<Msg>(bus_, channel, Delivery::latest(), [&](const Value& value) { newest = value; });
  }

  Site site_{box_tunnel()};
  MemoryBus bus_;
  SimNode node_{bus_, site_, {}, 1, kStart};
  std::map<std::string, int> counts_;
};

TEST_F(SimNodeTest, PublishesEveryChannelAtItsRate) {
  run(10.0);
  const std::map<std::string, int> hertz{
      {"TILT_FRONT", 50},    {"TILT_REAR", 50}, {"IMU", 100}, {"WHEEL_ODOMETRY", 20},
      {"VEHICLE_STATE", 10}, {"SINKAGE", 10},   {"GAS", 2},   {"TRUTH", 50},
      {"SIM_TIME", 20}};
  for (const auto& [channel, rate] : hertz) EXPECT_EQ(counts_[channel], 10 * rate) << channel;
  for (const char* laser : {"LASER_FRONT", "LASER_REAR"}) {
    EXPECT_NEAR(counts_[laser], 375, 1) << laser;  // one may not be complete yet
  }
  EXPECT_GE(counts_["RUN_STATE"], 10);  // and on change
}

TEST_F(SimNodeTest, FollowsDriveCommandsAndPublishesTheTruth) {
  StampedPose truth;
  store<pose_t>(channels::kTruth, truth);
  drive(kSpeed);
  run(10.0);
  EXPECT_EQ(truth.utime, kStart + 10'000'000);
  // Acceleration and slip take some of the four metres.
  EXPECT_GT(truth.T_odom_body.x, 2.5);
  EXPECT_LT(truth.T_odom_body.x, 4.0);
  ASSERT_TRUE(truth.v_body);
  EXPECT_NEAR(truth.v_body->x(), kSpeed, 0.1);  // slip
}

TEST_F(SimNodeTest, StandsUnderAStopOrder) {
  VehicleState state;
  store<vehicle_state_t>(channels::kVehicleState, state);
  drive(kSpeed);
  run(3.0);
  publish(bus_, channels::kStop, to_message(StopOrder{bus_.now_utime(), true, "test"}));
  run(3.0);
  EXPECT_TRUE(state.stopped);
  EXPECT_EQ(state.speed_m_s, 0.0);
}

TEST_F(SimNodeTest, TiltsTheCommandedLaser) {
  TiltReading front;
  TiltReading rear;
  store<tilt_t>(channels::kTiltFront, front);
  store<tilt_t>(channels::kTiltRear, rear);
  publish(bus_, channels::kTiltCommandRear, to_message(TiltCommand{kStart, 0.3, 0.5}));
  run(3.0);
  EXPECT_EQ(front.angle_rad, 0.0);
  EXPECT_NEAR(rear.angle_rad, 0.3, 1e-3);  // the encoder's step, and more
}

TEST_F(SimNodeTest, ReportsAFaultWhenTheRunHasFailed) {
  RunState state;
  store<run_state_t>(channels::kRunState, state);
  EXPECT_EQ(node_.health().level, Health::Level::kOk);
  drive(0.5);
  run(60.0);  // the end of the tunnel is 20 m ahead
  EXPECT_EQ(node_.health().level, Health::Level::kFault);
  EXPECT_FALSE(state.failure.empty());
  EXPECT_EQ(node_.health().reason, state.failure);
}

TEST_F(SimNodeTest, PublishesTheTimeAgainOnRequest) {
  std::vector<std::int64_t> times;
  subscribe<sim_time_t>(bus_, channels::kSimTime, Delivery::queued(10),
                        [&](const SimTime& time) { times.push_back(time.utime - kStart); });
  node_.publish_time();
  run(0.1);
  node_.publish_time();
  EXPECT_EQ(times, (std::vector<std::int64_t>{0, 50'000, 100'000, 100'000}));
}

}  // namespace
}  // namespace adit
