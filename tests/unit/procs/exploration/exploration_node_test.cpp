// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/exploration/exploration_node.hpp"

#include <optional>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "common/bus/channels.hpp"
#include "common/bus/memory_bus.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/exploration.hpp"
#include "common/messages/mapping/pose_graph.hpp"
#include "common/messages/navigation.hpp"
#include "tests/support/robots/exploring_robot.hpp"
#include "tests/unit/procs/exploration/test_mines.hpp"

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
    for (const LocalMapFragment& fragment : split(robot_.last_map())) {
      publish(bus_, channels::kLocalMap, to_message(fragment));
    }
  }
  void send_graph() {
    for (const PoseGraphFragment& fragment : split(robot_.graph())) {
      publish(bus_, channels::kPoseGraph, to_message(fragment));
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
    path.reason = "a beam blocks the path";
    path.reached_m = 1.0;
    publish(bus_, channels::kPath, to_message(path));
  }
  void send_request(int id, double remaining_m, bool returning_home = false,
                    std::optional<BlockedVerdict> blocked = {}) {
    const ExploreRequest request{robot_.utime(), id, remaining_m, returning_home,
                                 std::move(blocked)};
    publish(bus_, channels::kExploreRequest, to_message(request));
  }
  [[nodiscard]] BlockedVerdict verdict() const {
    return {robot_.utime(), reports_.back().decision.frontier, 1.0, "a beam blocks the path"};
  }
  [[nodiscard]] Pose2 body_in_odom() const { return kMapOdom.inverse() * robot_.T_map_body(); }

  static constexpr Pose2 kMapOdom{1.0, -2.0, 0.5};

  test::PlanarMine mine_ = tunnel_mine(straight());
  test::ExploringRobot robot_{mine_};
  MemoryBus bus_;
  ExplorationNode node_{bus_, ExplorationNodeParams{}};
  std::vector<ExplorationReport> reports_;
};

TEST_F(ExplorationNodeOnABus, DecidesOnEachGraph) {
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

TEST_F(ExplorationNodeOnABus, DecidesEverySecondWhileTheRobotMoves) {
  send_all();
  bus_.advance_to(robot_.utime() + 5 * kSecond);
  EXPECT_EQ(reports_.size(), 1U);
  robot_.drive({{2.0, 0.0}}, 2.0);
  send_pose();
  bus_.advance_to(robot_.utime() + 20 * kSecond);
  ASSERT_EQ(reports_.size(), 2U);
  EXPECT_NEAR(reports_[1].budget.remaining_m, ExplorationNodeParams{}.budget_m - 2.0, 0.01);
}

TEST_F(ExplorationNodeOnABus, MarksAFrontierAsBlockedAfterTwoFailedPlans) {
  send_all();
  send_no_path(1);
  EXPECT_EQ(reports_.size(), 1U);
  send_no_path(2);
  ASSERT_EQ(reports_.size(), 2U);
  const int frontier = reports_[0].decision.frontier;
  const Frontier& blocked = reports_[1].frontiers[static_cast<std::size_t>(frontier)];
  EXPECT_EQ(blocked.state, FrontierState::kBlocked);
  EXPECT_EQ(blocked.evidence, "the planner found no path (2): a beam blocks the path");
  EXPECT_EQ(reports_[1].decision.kind, Kind::kDone);
  EXPECT_TRUE(reports_[1].decision.complete);
}

TEST_F(ExplorationNodeOnABus, AnswersEachRequestWithItsRemainingBudget) {
  send_all();
  EXPECT_EQ(reports_.back().request, 0);
  send_request(7, 300.0);
  ASSERT_EQ(reports_.size(), 2U);
  EXPECT_EQ(reports_[1].request, 7);
  EXPECT_EQ(reports_[1].decision, reports_[0].decision);
  EXPECT_DOUBLE_EQ(reports_[1].budget.remaining_m, 300.0);
  robot_.drive({{2.0, 0.0}}, 2.0);
  send_pose();
  bus_.advance_to(robot_.utime() + kSecond);
  ASSERT_EQ(reports_.size(), 3U);
  EXPECT_EQ(reports_[2].request, 7);
  EXPECT_NEAR(reports_[2].budget.remaining_m, 298.0, 0.01);
  send_request(8, 12.0);  // with a reserve of 20 m
  ASSERT_EQ(reports_.size(), 4U);
  EXPECT_EQ(reports_[3].request, 8);
  EXPECT_EQ(reports_[3].decision.kind, Kind::kHome);
  EXPECT_FALSE(reports_[3].decision.complete);
}

TEST_F(ExplorationNodeOnABus, CountsAVerdictOncePerRequest) {
  mine_ = tunnel_mine(junction());
  robot_ = test::ExploringRobot(mine_);
  send_all();
  while (reports_.back().decision.kind != Kind::kAlong || reports_.back().frontiers.size() < 2) {
    ASSERT_LT(robot_.distance_travelled_m(), 40.0);
    const Eigen::Vector2d goal = reports_.back().decision.T_map_goal.translation();
    robot_.drive({{goal.x(), 0.0}}, 5.0);
    send_all();
  }
  const BlockedVerdict blocked = verdict();
  send_request(1, 300.0, false, blocked);
  const ExplorationReport first = reports_.back();
  EXPECT_EQ(first.request, 1);
  EXPECT_EQ(first.frontiers[static_cast<std::size_t>(blocked.frontier)].state,
            FrontierState::kBlocked);
  EXPECT_EQ(first.frontiers[static_cast<std::size_t>(blocked.frontier)].evidence, blocked.evidence);
  EXPECT_NE(first.decision.frontier, blocked.frontier);
  send_request(1, 300.0, false, verdict());  // for the next target, but of the same request
  EXPECT_EQ(reports_.back().decision, first.decision);
  EXPECT_EQ(reports_.back().frontiers, first.frontiers);
}

TEST_F(ExplorationNodeOnABus, IgnoresFailedPlansAfterTheFirstRequest) {
  send_all();
  send_request(1, 300.0);
  for (const int id : {1, 2, 3}) send_no_path(id);
  ASSERT_EQ(reports_.size(), 2U);
  send_request(2, 300.0);
  EXPECT_EQ(reports_.back().decision, reports_.front().decision);
}

TEST_F(ExplorationNodeOnABus, ReturnsHomeOnRequest) {
  send_all();
  robot_.drive({{5.0, 0.0}}, 5.0);
  send_all();
  send_request(1, 300.0, true);
  EXPECT_EQ(reports_.back().decision.kind, Kind::kHome);
  EXPECT_EQ(reports_.back().decision.frontier, ExplorationDecision::kNoFrontier);
  EXPECT_FALSE(reports_.back().decision.complete);
  send_graph();
  EXPECT_EQ(reports_.back().decision.kind, Kind::kHome);
  send_request(2, 300.0, false);
  EXPECT_EQ(reports_.back().decision.kind, Kind::kAlong);
}

TEST_F(ExplorationNodeOnABus, ReportsAMissingMapAndAnswersVerdictsLater) {
  send_request(1, 300.0);
  EXPECT_TRUE(reports_.empty());
  send_pose();
  send_request(1, 300.0);
  ASSERT_EQ(reports_.size(), 1U);
  EXPECT_EQ(reports_[0].request, 1);
  EXPECT_EQ(reports_[0].decision.kind, Kind::kStay);
  EXPECT_EQ(reports_[0].decision.reason, "there is no map yet");
  const BlockedVerdict blocked{robot_.utime(), 0, 1.0, "a beam blocks the path"};
  send_request(2, 300.0, false, blocked);
  EXPECT_EQ(reports_.size(), 1U);
  send_all();
  send_request(2, 300.0, false, blocked);
  EXPECT_EQ(reports_.back().request, 2);
  EXPECT_EQ(reports_.back().frontiers[0].state, FrontierState::kBlocked);
}

TEST_F(ExplorationNodeOnABus, RequestsAndReportsMissingLocalMaps) {
  send_correction();
  send_pose();
  robot_.drive({{5.0, 0.0}}, 5.0);
  send_map();
  send_graph();
  EXPECT_EQ(node_.health().reason, "1 local maps are missing");
}

}  // namespace
}  // namespace adit
