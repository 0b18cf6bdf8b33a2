// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/guard/guard_node.hpp"

#include <limits>
#include <sstream>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/bus/channels.hpp"
#include "common/bus/memory_bus.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/config/config.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/navigation.hpp"
#include "common/messages/sensing.hpp"
#include "tests/unit/procs/guard/healthy_robot.hpp"

namespace adit {
namespace {

constexpr std::int64_t kStart = 1'600'000'000'000'000;
constexpr std::int64_t kStepUs = 10'000;

class GuardNodeTest : public testing::Test {
 protected:
  GuardNodeTest() {
    subscribe<stop_t>(bus_, channels::kStop, Delivery::queued(100),
                      [this](const StopOrder& order) { orders_.push_back(order); });
  }

  /// Publishes a pose and a command each 50 ms, unless switched off.
  void run(double seconds) {
    for (int i = 0; i < std::lround(seconds * 1e6 / kStepUs); ++i) {
      bus_.advance_to(now_ += kStepUs);
      if (now_ % 50'000 != 0) continue;
      if (poses_) publish(bus_, channels::kPose, to_message(StampedPose{now_, {}, {}}));
      publish(bus_, channels::kDriveCommand, to_message(DriveCommand{now_, speed_m_s_, 0.0}));
    }
  }
  void beat(const std::string& stage) {
    publish(bus_, channels::kHeartbeat, to_message(Heartbeat{now_, stage, {}, 0, 0, 0}));
  }

  MemoryBus bus_;
  GuardNode node_{bus_, groundhog_guard()};
  std::vector<StopOrder> orders_;
  std::int64_t now_ = kStart;
  bool poses_ = true;
  double speed_m_s_ = 0.0;
};

TEST_F(GuardNodeTest, PublishesAStopImmediately) {
  bus_.advance_to(kStart);
  ASSERT_EQ(orders_.size(), 1U);
  EXPECT_EQ(orders_[0], (StopOrder{kStart, true, "no pose received yet; no command received yet"}));
}

TEST_F(GuardNodeTest, RepeatsTheOrderAt10Hz) {
  run(2.0);
  orders_.clear();
  run(2.0);
  EXPECT_EQ(orders_.size(), 20U);
  for (const StopOrder& order : orders_) EXPECT_FALSE(order.stopped);
}

TEST_F(GuardNodeTest, PublishesAStopWithinOneTimerPeriod) {
  run(2.0);
  poses_ = false;
  orders_.clear();
  const std::int64_t last_pose = now_;
  run(0.4);
  const auto stop = std::ranges::find_if(orders_, &StopOrder::stopped);
  ASSERT_NE(stop, orders_.end());
  EXPECT_GT(stop->utime, last_pose + 250'000);
  EXPECT_LE(stop->utime, last_pose + 250'000 + GuardNode::kEvaluationPeriodUs);
  EXPECT_THAT(stop->reason, testing::StartsWith("pose stale"));
}

TEST_F(GuardNodeTest, MonitorsTheHeartbeatOfTheSupervisorOnly) {
  beat("mapping");
  run(10.0);
  EXPECT_FALSE(orders_.back().stopped);
  beat("supervisor");
  run(2.9);
  EXPECT_FALSE(orders_.back().stopped);
  beat("mapping");
  run(0.3);
  EXPECT_THAT(orders_.back().reason, testing::StartsWith("supervisor stale for 3."));
  beat("supervisor");
  run(1.0);
  EXPECT_FALSE(orders_.back().stopped);
}

TEST_F(GuardNodeTest, StopsWhileAnybodyOrdersAStop) {
  run(2.0);
  EXPECT_FALSE(orders_.back().stopped);
  publish(bus_, channels::kStop, to_message(StopOrder{now_ + 1, true, "by hand"}));
  run(0.1);
  EXPECT_THAT(orders_.back().reason, testing::HasSubstr("stop ordered by another"));
  run(0.8);
  EXPECT_TRUE(orders_.back().stopped);
  run(1.0);  // kForeignStopS has passed, then hold_s
  EXPECT_FALSE(orders_.back().stopped);
}

TEST_F(GuardNodeTest, IgnoresInvalidMessages) {
  run(1.0);
  EXPECT_FALSE(orders_.back().stopped);
  speed_m_s_ = std::numeric_limits<double>::quiet_NaN();
  run(0.5);
  EXPECT_THAT(orders_.back().reason, testing::StartsWith("command stale"));
}

TEST_F(GuardNodeTest, IsDegradedByTheRobotNotByTheDriver) {
  run(1.0);
  EXPECT_EQ(node_.health(), Health{});
  publish(bus_, channels::kGas, to_message(GasReading{now_, 0.02, 0.2, 0.0}));
  run(0.1);
  EXPECT_EQ(node_.health().level, Health::Level::kDegraded);
  EXPECT_EQ(node_.health().reason,
            "methane 2.00 %, limit 1.00 % (count: pose 1, command 1, gas 1)");
  run(20.0);  // gas becomes stale
  EXPECT_THAT(node_.health().reason, testing::StartsWith("gas stale"));
}

TEST(GuardConfiguration, RejectsLasersThatSeeNoObstacles) {
  GuardParams params = groundhog_guard();
  EXPECT_NO_THROW(Guard{params});
  params.lasers.rear.height_m = 0.1;
  EXPECT_THROW(Guard{params}, std::invalid_argument);
  EXPECT_THROW(Guard{GuardParams{}}, std::invalid_argument);  // lasers on the ground
  params = groundhog_guard();
  params.obstacle.margin_m = 0.04;  // the laser is blind up to 0.05 m ahead of the vehicle
  EXPECT_THROW(Guard{params}, std::invalid_argument);
  params = groundhog_guard();
  params.tilt_margin_rad = 0.5;
  EXPECT_THROW(Guard{params}, std::invalid_argument);
}

TEST(GuardConfiguration, RejectsDisabledTimeouts) {
  for (const char* key : {"timeout_s", "slow_timeout_s", "supervisor_timeout_s"}) {
    for (const char* value : {"0", "-1", ".nan", ".inf", "1e9"}) {
      const std::string yaml = std::string("guard: {") + key + ": " + value + "}\n";
      EXPECT_THROW(load_section<GuardParams>(ConfigFile::parse(yaml, "test"), "guard"), ConfigError)
          << yaml;
    }
  }
}

}  // namespace
}  // namespace adit
