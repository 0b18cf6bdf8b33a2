// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// A path planned on one 3D scan of a simulated mine, with both ground estimators.
#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "procs/planning/planning.hpp"
#include "procs/terrain/terrain.hpp"
#include "sim/sweep/tilt_sweep.hpp"
#include "sim/world/build_world.hpp"
#include "sim/world/plan/tunnel_line.hpp"
#include "sim/world/world_file.hpp"
#include "tests/support/scores/path_feasibility.hpp"

namespace adit {
namespace {

using Reason = BlockingCell::Reason;

/// A rough straight tunnel, 3.2 m wide and 2 m high, with the robot at x = 5.
WorldDescription tunnel() {
  WorldDescription mine;
  mine.name = "tunnel";
  mine.seed = 3;
  mine.plan.tunnels.push_back({.name = "main", .points_m = {0.0, 0.0, 30.0, 0.0}, .width_m = 3.2});
  mine.heights.floor_relief.height_m = 0.01;
  mine.wall_relief.height_m = 0.08;
  mine.T_world_start = {5.0, 0.0, 0.0};
  return mine;
}

class SingleScan : public testing::TestWithParam<const char*> {
 protected:
  PlannedPath plan(const WorldDescription& mine, const Pose2& T_world_robot, double distance_m) {
    const Site site(build_world(mine));
    const Eigen::Isometry3d T_world_body = standing(site, T_world_robot);
    const Cloud cloud = tilt_sweep(site, T_world_body);
    TerrainParams params;
    params.estimator.kind = GetParam();
    PlanGoal goal;
    goal.T_odom_goal = T_world_robot;
    goal.distance_m = distance_m;
    const PlannedPath path =
        Planning(PlanningParams{}).plan(Terrain(params).make(cloud), goal, cloud.T_odom_level);
    expect_free(site, T_world_body, path);
    return path;
  }
  PlannedPath plan(const WorldDescription& mine, double distance_m = 10.0) {
    return plan(mine, mine.T_world_start, distance_m);
  }

 private:
  static void expect_free(const Site& site, const Eigen::Isometry3d& T_world_body,
                          const PlannedPath& path) {
    std::vector<Pose2> poses;
    for (const PathPoint& point : path.points) poses.push_back(point.T_odom_body);
    const auto fault = find_first_fault(site, Vehicle{}, T_world_body.translation().z(), poses);
    EXPECT_FALSE(fault) << fault->what << " after " << fault->driven_m << " m";
  }
};
INSTANTIATE_TEST_SUITE_P(OfBothEstimators, SingleScan, testing::Values("kth", "paper"),
                         [](const auto& test) { return std::string(test.param); });

/// Bounding boxes of beam and cables, inflated by a region of the terrain and half a cell.
std::vector<Eigen::AlignedBox2d> beam_and_cables(const World& world) {
  std::vector<Eigen::AlignedBox2d> boxes;
  for (const Obstacle& obstacle : world.truth.obstacles) {
    if (obstacle.kind != PartKind::kBeam && obstacle.kind != PartKind::kCable) continue;
    Eigen::AlignedBox2d box;
    for (const Eigen::Vector2d& p : obstacle.outline) box.extend(p);
    boxes.emplace_back(box.min().array() - 0.15, box.max().array() + 0.15);
  }
  return boxes;
}

bool any_near(const std::vector<Eigen::AlignedBox2d>& boxes, const Eigen::Vector2d& p_world) {
  return std::any_of(boxes.begin(), boxes.end(),
                     [&](const auto& box) { return box.contains(p_world); });
}

int count(const PlannedPath& path, Reason reason) {
  return static_cast<int>(std::count_if(path.blocking.begin(), path.blocking.end(),
                                        [&](const auto& cell) { return cell.reason == reason; }));
}

void expect_rejected(const PlannedPath& path, Reason reason, double from_x, double to_x) {
  EXPECT_NE(path.outcome, PlanOutcome::kFound) << path.reason;
  EXPECT_TRUE(path.points.empty());
  EXPECT_LT(path.reached_m, 2.5);
  int cells = 0;
  for (const BlockingCell& cell : path.blocking) {
    const bool on = cell.p_odom.x() > from_x && cell.p_odom.x() < to_x;
    if (cell.reason == reason && on) ++cells;
  }
  EXPECT_GT(cells, 5) << path.reason;
}

TEST_P(SingleScan, FindsAPathInAFreeCorridor) {
  const PlannedPath path = plan(tunnel(), 12.0);
  ASSERT_EQ(path.outcome, PlanOutcome::kFound) << path.reason;
  EXPECT_GT(path.reached_m, 10.0);
}

TEST_P(SingleScan, StraddlesRails) {
  WorldDescription mine = tunnel();
  mine.props.rails.push_back({.tunnel = "main", .from_m = 1.0, .to_m = 28.0, .across_m = 0.3});
  const PlannedPath path = plan(mine);
  ASSERT_EQ(path.outcome, PlanOutcome::kFound) << path.reason;
  const Vehicle vehicle;
  int points_on_rails = 0;
  for (const PathPoint& point : path.points) {
    for (const double rail : {0.0, 0.6}) {
      for (const double side : {-0.5, 0.5}) {
        const double track = point.T_odom_body.y + side * vehicle.track_m;
        if (std::abs(track - rail) < vehicle.wheel_width_m / 2.0) ++points_on_rails;
      }
    }
  }
  // Only at the start, to leave the rail beside the robot.
  EXPECT_LT(points_on_rails, static_cast<int>(path.points.size()) / 4);
}

TEST_P(SingleScan, PassesAPost) {
  WorldDescription mine = tunnel();
  mine.props.posts.push_back({.tunnel = "main", .from_m = 9.0, .to_m = 9.0, .across_m = -0.3});
  const PlannedPath path = plan(mine);
  ASSERT_EQ(path.outcome, PlanOutcome::kFound) << path.reason;
  EXPECT_GT(path.reached_m, 6.0);
}

TEST_P(SingleScan, RejectsTheBrokenBeamOfMathies) {
  const WorldDescription mine = find_world("mathies");
  const auto tunnels = tunnel_lines(mine.plan);
  const TunnelLine& main = find_tunnel(tunnels, "main", "test");
  const auto station = main.at(308.0);
  const PlannedPath path =
      plan(mine, {station.p_world.x(), station.p_world.y(), station.heading_rad}, 10.0);
  EXPECT_NE(path.outcome, PlanOutcome::kFound);
  EXPECT_TRUE(path.points.empty());
  EXPECT_LT(path.reached_m, 2.5);
  EXPECT_THAT(path.reason, testing::HasSubstr("blocked by an obstacle that is too high to drive over"));
  const auto boxes = beam_and_cables(build_world(mine));
  int cells_on_obstacles = 0;
  for (const BlockingCell& cell : path.blocking) {
    if (cell.reason == Reason::kBelly && any_near(boxes, cell.p_odom)) ++cells_on_obstacles;
  }
  EXPECT_GT(cells_on_obstacles, 10);
}

TEST_P(SingleScan, RejectsALowRoof) {
  for (const double from :
       {7.6, 8.2}) {  // in front of it, less than 2.5 m remain, which is not a path
    WorldDescription mine = tunnel();
    mine.props.low_roofs.push_back(
        {.name = "low", .tunnel = "main", .from_m = from, .to_m = from + 4.0, .clearance_m = 0.9});
    const PlannedPath path = plan(mine);
    EXPECT_NE(path.outcome, PlanOutcome::kFound) << path.reason;
    EXPECT_GT(count(path, Reason::kBelly) + count(path, Reason::kRoof), 5);
  }
}

TEST_P(SingleScan, RejectsAPit) {
  WorldDescription mine = tunnel();
  mine.props.pits.push_back(
      {.name = "pit", .tunnel = "main", .at_m = 9.2, .radius_m = 1.5, .depth_m = 1.5});
  expect_rejected(plan(mine), Reason::kDrop, 7.5, 11.0);
}

TEST_P(SingleScan, RejectsRubble) {
  WorldDescription mine = tunnel();
  mine.props.rubble.push_back({.tunnel = "main", .at_m = 9.0, .radius_m = 1.8, .height_m = 1.2});
  expect_rejected(plan(mine), Reason::kBelly, 7.0, 10.5);
}

TEST_P(SingleScan, RejectsWater) {
  for (const bool mirror : {false, true}) {
    WorldDescription mine = tunnel();
    mine.props.water.push_back({.name = "water",
                                .tunnel = "main",
                                .from_m = 8.2,
                                .to_m = 16.0,
                                .depth_m = 0.8,
                                .mirror = mirror});
    const PlannedPath path = plan(mine);
    EXPECT_NE(path.outcome, PlanOutcome::kFound) << path.reason << ' ' << path.reached_m;
  }
}

}  // namespace
}  // namespace adit
