// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/exploration/exploration_node.hpp"

#include <vector>

#include <gtest/gtest.h>

#include "common/bus/channels.hpp"
#include "common/bus/memory_bus.hpp"
#include "common/bus/typed.hpp"
#include "common/messages/exploration_report.hpp"
#include "common/messages/map_correction.hpp"
#include "common/messages/planned_path.hpp"
#include "tests/support/exploring_robot.hpp"
#include "tests/unit/procs/exploration/mines.hpp"

namespace adit {
namespace {

using Kind = ExplorationDecision::Kind;
constexpr std::int64_t kSecond = 1'000'000;

class ExplorationNodeOnABus : public testing::Test {
 protected:
  ExplorationNodeOnABus() {
    subscribe<exploration_t>(bus_, channels::kExploration, Delivery::queued(100),
                             [this](const ExplorationReport& r) { reports_.push_back(r); });
  }

  void send_map() {
    for (const LocalMapPiece& piece : divide(robot_.last_map())) {
      publish(bus_, channels::kLocalMap, to_message(piece));
    }
  }
  void send_graph() {
    for (const PoseGraphPiece& piece : divide(robot_.graph())) {
      publish(bus_, channels::kPoseGraph, to_message(piece));
    }
  }
  void send_pose() {
    publish(bus_, channels::kPose, to_message(StampedPose{robot_.utime(), body_in_odom(), {}}));
  }
  void send_correction() {
    MapCorrection correction;
    correction.utime = robot_.utime();
    correction.T_map_odom = kMapOdom;
    publish(bus_, channels::kMapCorrection, to_message(correction));
  }
  void send_all() {
    send_correction();
    send_pose();
    send_map();
    send_graph();
  }
  void send_no_path(int id) {
    PlannedPath path;
    path.utime = robot_.utime();
    path.id = id;
    path.outcome = PlanOutcome::kBlocked;
    path.reason = "a beam is in the way";
    path.reached_m = 1.0;
    publish(bus_, channels::kPath, to_message(path));
  }
  [[nodiscard]] Pose2 body_in_odom() const { return kMapOdom.inverse() * robot_.T_map_body(); }

  static constexpr Pose2 kMapOdom{1.0, -2.0, 0.5};

  test::LightMine mine_ = drift_mine(straight());
  test::ExploringRobot robot_{mine_};
  MemoryBus bus_;
  ExplorationNode node_{bus_, ExplorationNodeParams{}};
  std::vector<ExplorationReport> reports_;
};

TEST_F(ExplorationNodeOnABus, DecidesWithEachGraph) {
  send_all();
  ASSERT_EQ(reports_.size(), 1U);
  const ExplorationReport& report = reports_[0];
  EXPECT_EQ(report.decision.kind, Kind::kAlong);
  EXPECT_EQ(report.revision, 1);
  EXPECT_DOUBLE_EQ(report.budget.remaining_m, ExplorationNodeParams{}.budget_m);
  const Pose2 T_map_goal = kMapOdom * report.T_odom_goal;
  EXPECT_NEAR(T_map_goal.x, report.decision.T_map_goal.x, 1e-9);
  EXPECT_NEAR(T_map_goal.y, report.decision.T_map_goal.y, 1e-9);
  EXPECT_EQ(node_.health(), Health{});
}

TEST_F(ExplorationNodeOnABus, DecidesEachSecondWhileTheRobotMoves) {
  send_all();
  bus_.advance_to(robot_.utime() + 5 * kSecond);
  EXPECT_EQ(reports_.size(), 1U);
  robot_.go({{2.0, 0.0}}, 2.0);
  send_pose();
  bus_.advance_to(robot_.utime() + 20 * kSecond);
  ASSERT_EQ(reports_.size(), 2U);
  EXPECT_NEAR(reports_[1].budget.remaining_m, ExplorationNodeParams{}.budget_m - 2.0, 0.01);
}

TEST_F(ExplorationNodeOnABus, TakesAStubForBlockedAfterTwoAnswersWithoutAPath) {
  send_all();
  send_no_path(1);
  EXPECT_EQ(reports_.size(), 1U);
  send_no_path(2);
  ASSERT_EQ(reports_.size(), 2U);
  const int stub = reports_[0].decision.stub;
  const Stub& blocked = reports_[1].stubs[static_cast<std::size_t>(stub)];
  EXPECT_EQ(blocked.state, StubState::kBlocked);
  EXPECT_EQ(blocked.evidence, "the planner found no path (2): a beam is in the way");
  EXPECT_EQ(reports_[1].decision.kind, Kind::kDone);
  EXPECT_TRUE(reports_[1].decision.complete);
}

TEST_F(ExplorationNodeOnABus, SaysWhatLocalMapsItLacks) {
  send_correction();
  send_pose();
  robot_.go({{5.0, 0.0}}, 5.0);
  send_map();
  send_graph();
  EXPECT_EQ(node_.health().reason, "1 local maps never came");
}

}  // namespace
}  // namespace adit
