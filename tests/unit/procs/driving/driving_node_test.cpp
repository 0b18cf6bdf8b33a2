// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/driving/driving_node.hpp"

#include <vector>

#include <gtest/gtest.h>

#include "common/bus/channels.hpp"
#include "common/bus/memory_bus.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/navigation.hpp"
#include "tests/support/drives/test_paths.hpp"

namespace adit {
namespace {

using Kind = DrivingState::Kind;

constexpr std::int64_t kUtime = 1'600'000'000'000'000;

class DrivingNodeTest : public testing::Test {
 protected:
  DrivingNodeTest() {
    subscribe<drive_command_t>(
        bus_, channels::kDriveCommand, Delivery::queued(100),
        [this](const DriveCommand& command) { commands_.push_back(command); });
    subscribe<driving_state_t>(bus_, channels::kDrivingState, Delivery::queued(100),
                               [this](const DrivingState& state) { states_.push_back(state); });
    bus_.advance_to(kUtime);
  }

  void send_path(double length_m = 8.0) {
    PlannedPath path = TestPathBuilder({}).forward(length_m).path();
    path.utime = kUtime;
    path.id = 5;
    publish(bus_, channels::kPath, to_message(path));
  }
  void send_match(ScanMatch::Status status) {
    ScanMatch match;
    match.utime = bus_.now_utime();
    match.status = status;
    publish(bus_, channels::kScanMatch, to_message(match));
  }
  /// Publishes poses of a standing robot at 20 Hz.
  void wait(double seconds, const Pose2& T_odom_body = {}) {
    for (int i = 0; i < std::lround(seconds / 0.05); ++i) {
      bus_.advance_to(bus_.now_utime() + 50'000);
      const StampedPose pose{bus_.now_utime(), T_odom_body, {}};
      publish(bus_, channels::kPose, to_message(pose));
    }
  }

  MemoryBus bus_;
  DrivingNode node_{bus_, DrivingParams{}};
  std::vector<DriveCommand> commands_;
  std::vector<DrivingState> states_;
};

TEST_F(DrivingNodeTest, PublishesCommandsAt20HzAlsoToStand) {
  bus_.advance_to(kUtime + 1'000'000);
  ASSERT_EQ(commands_.size(), 21U);
  for (std::size_t i = 0; i < commands_.size(); ++i) {
    EXPECT_EQ(commands_[i].speed_m_s, 0.0);
    EXPECT_EQ(commands_[i].utime, kUtime + static_cast<std::int64_t>(i) * 50'000);
  }
  EXPECT_EQ(states_.size(), 6U);  // five a second
  EXPECT_EQ(states_.back().kind, Kind::kIdle);
  EXPECT_EQ(node_.health(), Health{});
}

TEST_F(DrivingNodeTest, DrivesAPathAndPublishesChangesImmediately) {
  wait(0.1);
  send_path();
  states_.clear();
  wait(0.05);
  ASSERT_EQ(states_.size(), 1U);
  EXPECT_EQ(states_[0].kind, Kind::kDriving);
  EXPECT_EQ(states_[0].path_id, 5);
  EXPECT_NEAR(states_[0].remaining_m, 8.0, 1e-6);
  wait(1.0);
  EXPECT_GT(commands_.back().speed_m_s, 0.1);
  EXPECT_EQ(node_.health(), Health{});
}

TEST_F(DrivingNodeTest, IsDegradedWhileNotLocalized) {
  send_path();
  bus_.advance_to(bus_.now_utime() + 100'000);
  EXPECT_EQ(node_.health(), (Health{Health::Level::kDegraded, "no pose received yet"}));
  wait(1.0);
  EXPECT_EQ(node_.health(), Health{});
  send_match(ScanMatch::Status::kLost);
  wait(1.0);
  EXPECT_EQ(node_.health(), (Health{Health::Level::kDegraded, "scan matching is lost"}));
  EXPECT_EQ(commands_.back().speed_m_s, 0.0);
}

TEST_F(DrivingNodeTest, ReportsThatTheVehicleIsHeld) {
  send_path();
  wait(0.5);
  VehicleState state;
  state.utime = bus_.now_utime();
  state.stopped = true;
  publish(bus_, channels::kVehicleState, to_message(state));
  wait(0.05);
  EXPECT_EQ(states_.back().kind, Kind::kWaiting);
  EXPECT_EQ(node_.health(), (Health{Health::Level::kDegraded, "held by a stop order"}));
}

TEST_F(DrivingNodeTest, ReportsAFaultBesideThePath) {
  send_path();
  wait(0.5, {0.0, 1.0, 0.0});
  EXPECT_EQ(node_.health().level, Health::Level::kFault);
  EXPECT_EQ(states_.back().kind, Kind::kFailed);
  EXPECT_EQ(states_.back().reason, node_.health().reason);
}

}  // namespace
}  // namespace adit
