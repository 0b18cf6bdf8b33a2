// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Invalid commands on the bus of the simulator.
#include <limits>

#include <gtest/gtest.h>

#include "common/bus/channels.hpp"
#include "common/bus/memory_bus.hpp"
#include "common/bus/node/node_host.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/navigation.hpp"
#include "common/messages/sensing.hpp"
#include "sim/sim_node.hpp"
#include "tests/support/worlds/box_tunnel.hpp"

namespace adit {
namespace {

constexpr std::int64_t kStart = 1'600'000'000'000'000;
constexpr std::int64_t kYear = 31'536'000'000'000;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

class SimNodeCommands : public testing::Test {
 protected:
  SimNodeCommands() {
    subscribe<vehicle_state_t>(bus_, channels::kVehicleState, Delivery::latest(),
                               [this](const VehicleState& state) { state_ = state; });
    subscribe<tilt_t>(bus_, channels::kTiltFront, Delivery::latest(),
                      [this](const TiltReading& tilt) { tilt_ = tilt; });
    subscribe<heartbeat_t>(bus_, channels::kHeartbeat, Delivery::latest(),
                           [this](const Heartbeat& heartbeat) { heartbeat_ = heartbeat; });
  }

  void run(double seconds) {
    const std::int64_t end = node_.simulation().utime() + std::llround(seconds * 1e6);
    while (node_.simulation().utime() < end) {
      bus_.advance_to(node_.next_utime());
      node_.step();
    }
  }

  void send(const DriveCommand& command) {
    publish(bus_, channels::kDriveCommand, to_message(command));
  }
  void send(const StopOrder& order) { publish(bus_, channels::kStop, to_message(order)); }
  void send(const TiltCommand& command) {
    publish(bus_, channels::kTiltCommandFront, to_message(command));
  }

  /// Publishes 20 times a second with stamps that are wrong by `offset_us`.
  void drive(double speed_m_s, std::int64_t offset_us) {
    bus_.create_timer(50'000, [this, speed_m_s, offset_us](std::int64_t utime) {
      send(DriveCommand{utime + offset_us, speed_m_s, 0.0});
    });
  }

  Site site_{box_tunnel()};
  MemoryBus bus_;
  NodeHost host_{bus_, {"sim", "", ""}};
  SimNode node_{host_.bus(), site_, {}, 1, kStart};
  VehicleState state_;
  TiltReading tilt_;
  Heartbeat heartbeat_;
};

TEST_F(SimNodeCommands, ThatAreNotFiniteAreRejectedAndCounted) {
  std::int64_t sent = 0;
  for (const double bad : {kNaN, kInfinity, -kInfinity}) {
    // One by one, since only the newest of several queued commands is handled.
    for (const DriveCommand& command : {DriveCommand{kStart, bad, 0.0}, {kStart, 0.4, bad}}) {
      send(command);
      run(0.05);
      ++sent;
    }
    for (const TiltCommand& command : {TiltCommand{kStart, bad, 0.5}, {kStart, 0.3, bad}}) {
      send(command);
      run(0.05);
      ++sent;
    }
  }
  run(1.5);
  EXPECT_EQ(heartbeat_.rejected, sent);
  EXPECT_EQ(heartbeat_.health.level, Health::Level::kOk);
  EXPECT_EQ(state_.speed_m_s, 0.0);
  EXPECT_TRUE(state_.expired);
  EXPECT_EQ(tilt_.angle_rad, 0.0);
}

TEST_F(SimNodeCommands, BeyondTheLimitsAreClamped) {
  send(TiltCommand{kStart, 6.0, 15.0});
  bus_.create_timer(50'000, [this](std::int64_t utime) { send(DriveCommand{utime, 25.0, -90.0}); });
  run(1.5);
  const Vehicle vehicle;
  EXPECT_GT(state_.speed_m_s, 0.0);
  EXPECT_LE(state_.speed_m_s, vehicle.speed_max_m_s);
  EXPECT_LT(state_.curvature_1_m, 0.0);
  EXPECT_GE(state_.curvature_1_m, -1.0 / vehicle.turning_radius_m);
  run(1.0);
  EXPECT_NEAR(tilt_.angle_rad, TiltParams{}.angle_max_rad, TiltParams{}.encoder_step_rad);
  EXPECT_EQ(heartbeat_.rejected, 0);
}

TEST_F(SimNodeCommands, WithInvalidTimesAreRejectedAndCounted) {
  for (const std::int64_t utime : {INT64_MIN, INT64_C(-1), INT64_MAX}) {
    send(DriveCommand{utime, 0.4, 0.0});
    send(StopOrder{utime, true, "never"});
    send(TiltCommand{utime, 0.3, 0.5});
    run(0.05);
  }
  run(1.5);
  EXPECT_EQ(heartbeat_.rejected, 9);
  EXPECT_FALSE(state_.stopped);
  EXPECT_TRUE(state_.expired);
  EXPECT_EQ(tilt_.angle_rad, 0.0);
}

TEST_F(SimNodeCommands, FromThePastDoNotMoveTheVehicle) {
  drive(0.4, -kYear);
  run(2.0);
  EXPECT_TRUE(state_.expired);
  EXPECT_EQ(state_.speed_m_s, 0.0);
}

TEST_F(SimNodeCommands, FromTheFutureExpireAsOthersDo) {
  send(DriveCommand{kStart + kYear, 0.4, 0.0});
  run(2.0);
  EXPECT_TRUE(state_.expired);
  EXPECT_EQ(state_.speed_m_s, 0.0);
  drive(0.4, 0);  // and do not block later valid commands
  run(2.0);
  EXPECT_FALSE(state_.expired);
  EXPECT_GT(state_.speed_m_s, 0.3);
}

TEST_F(SimNodeCommands, AStopFromTheFutureIsReleasedByACurrentOrder) {
  drive(0.4, 0);
  send(StopOrder{kStart + kYear, true, "a clock is wrong"});
  run(2.0);
  EXPECT_TRUE(state_.stopped);
  EXPECT_EQ(state_.speed_m_s, 0.0);
  for (int i = 0; i < 20; ++i) {  // orders must keep arriving
    send(StopOrder{bus_.now_utime(), false, ""});
    run(0.1);
  }
  EXPECT_FALSE(state_.stopped);
  EXPECT_GT(state_.speed_m_s, 0.3);
}

}  // namespace
}  // namespace adit
