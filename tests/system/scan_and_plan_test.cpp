// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// A simulated robot scans a tunnel and plans a path: all nodes from the laser to the path on one
// bus.
#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/robots/planning_robot.hpp"
#include "tests/support/robots/simulated_robot.hpp"
#include "tests/support/worlds/box_tunnel.hpp"

namespace adit {
namespace {

using Robot = PlanningRobot<GroundTruthRobot>;

TEST(ScanAndPlan, FindsAPathInAFreeTunnel) {
  Robot robot(box_tunnel());
  robot.scan_and_plan(8.0);
  EXPECT_EQ(robot.terrain_count(), 1);
  const PlannedPath& path = robot.path();
  EXPECT_EQ(path.outcome, PlanOutcome::kFound) << path.reason;
  EXPECT_EQ(path.id, Robot::kGoal);
  EXPECT_EQ(robot.terrain_health(), Health{});
  ASSERT_FALSE(path.points.empty());
  EXPECT_GT(path.points.back().T_odom_body.x, 7.0);
  // Half the tunnel width minus half the vehicle width, and a cell.
  for (const PathPoint& point : path.points) EXPECT_LT(std::abs(point.T_odom_body.y), 1.5);
}

TEST(ScanAndPlan, ReportsBlockingCells) {
  Robot robot(box_tunnel({}, [](MeshBuilder& builder) {
    builder.begin_part(PartKind::kWall, Material::kRock, "rubble");
    builder.box(level_box({3.2, 0.0, 0.4}, {0.6, 4.0, 0.8}));
  }));
  robot.scan_and_plan(8.0);
  EXPECT_EQ(robot.terrain_count(), 1);
  const PlannedPath& path = robot.path();
  EXPECT_EQ(path.id, Robot::kGoal);
  EXPECT_NE(path.outcome, PlanOutcome::kFound);
  EXPECT_TRUE(path.points.empty());
  EXPECT_FALSE(path.reason.empty());
  EXPECT_LT(path.reached_m, 2.0);
  EXPECT_FALSE(path.blocking.empty());
}

}  // namespace
}  // namespace adit
