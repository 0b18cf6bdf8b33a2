// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/reachable_area.hpp"

#include <algorithm>
#include <numeric>

#include <gtest/gtest.h>

#include "sim/world/build_world.hpp"
#include "tests/support/passable_raster.hpp"
#include "tests/support/worlds/box_tunnel.hpp"

namespace adit {
namespace {

// A vehicle may be off the centre of its cell, and squares of 0.1 m count completely.
constexpr double kCellAndSquare = 0.3;

Obstacle block(double x_low, double x_high, double y_low, double y_high) {
  return {.kind = PartKind::kCrib,
          .name = "block",
          .outline = {{x_low, y_low}, {x_high, y_low}, {x_high, y_high}, {x_low, y_high}},
          .z_low_m = 0.0,
          .z_high_m = 2.0};
}

/// In it, the vehicle cannot stand across.
World narrow_tunnel() { return box_tunnel({.length_m = 40.0, .width_m = 2.2, .height_m = 2.0}); }

double farthest_x(const ReachableArea& area) {
  double farthest = -100.0;
  for (const Eigen::Vector2d& cell : area.cells) farthest = std::max(farthest, cell.x());
  return farthest;
}

double reached_m(const ReachableArea& area) {
  return std::accumulate(area.edge_length_m.begin(), area.edge_length_m.end(), 0.0);
}

TEST(ReachableArea, OfABoxIsTheBoxLessHalfTheVehicle) {
  const Vehicle vehicle;
  const ReachableArea area = reachable_area(narrow_tunnel(), vehicle);
  // The centre keeps half of the length from the ends and half of the width from the sides.
  EXPECT_NEAR(farthest_x(area), 20.0 - vehicle.length_m / 2.0, kCellAndSquare);
  const double width = 2.2 - vehicle.width_m;
  const double length = 40.0 - vehicle.length_m;
  EXPECT_NEAR(area.area_m2, width * length, 0.2 * (width + length));
}

TEST(ReachableArea, EndsAtAPostThatBlocksTheTunnel) {
  World world = narrow_tunnel();
  world.truth.obstacles = {block(5.0, 5.3, -0.1, 0.1)};  // 1.0 m to either side
  EXPECT_NEAR(farthest_x(reachable_area(world, {})), 5.0 - 1.2, kCellAndSquare);
}

TEST(ReachableArea, ContinuesBehindAPostThatLeavesRoom) {
  World world = box_tunnel();
  world.truth.obstacles = {block(5.0, 5.3, -0.3, 0.3)};  // 1.7 m to either side
  EXPECT_GT(farthest_x(reachable_area(world, {})), 18.0);
}

TEST(ReachableArea, IsEmptyWhereTheVehicleDoesNotFit) {
  World world = box_tunnel({.length_m = 40.0, .width_m = 1.0, .height_m = 2.0});
  EXPECT_TRUE(reachable_area(world, {}).cells.empty());
  world = box_tunnel();
  world.T_world_start = {500.0, 0.0, 0.0};
  EXPECT_TRUE(reachable_area(world, {}).cells.empty());
  world.truth.plan.clear();
  EXPECT_EQ(reachable_area(world, {}).area_m2, 0.0);
}

TEST(ReachableArea, CountsTheLengthOfTunnelsAndTheGroundOutside) {
  WorldDescription description;
  description.grid_m = 0.2;
  description.plan.tunnels = {{"main", {0.0, 0.0, 40.0, 0.0}, 3.0, true},
                              {"side", {20.0, 0.0, 20.0, 30.0}, 3.0, false},
                              {"narrow", {30.0, 0.0, 30.0, 30.0}, 1.1, false}};
  description.T_world_start = {0.0, 0.0, 0.0};  // half outside
  const World world = build_world(description);
  const Vehicle vehicle;
  const ReachableArea area = reachable_area(world, vehicle);
  ASSERT_EQ(area.edge_length_m.size(), world.truth.tunnels.edges.size());
  const double half_length = vehicle.length_m / 2.0;
  // Its front may enter the narrow one; its centre stays in the wide one, 1.5 m to either side.
  const double expected = 40.0 - half_length + 30.0 - half_length;
  EXPECT_NEAR(reached_m(area), expected, 1.5 + 3 * 0.3);
}

WorldDescription graded(double grade_percent, double step_m) {
  WorldDescription description;
  description.heights.floor_relief.height_m = 0.0;
  TunnelDescription main{"main", {0.0, 0.0, 40.0, 0.0}, 3.0, true};
  main.rise_m = {15.0, 0.0, 25.0, 0.1 * grade_percent, 35.0, 0.1 * grade_percent};
  if (step_m != 0.0) main.rise_m = {15.0, 0.0, 15.05, step_m};
  main.rise_grade = "sudden";
  description.plan.tunnels = {main};
  description.T_world_start = {3.0, 0.0, 0.0};
  return description;
}

TEST(ReachableArea, EndsAtAGradeThatIsTooSteep) {
  const auto reach = [](double grade_percent) {
    return farthest_x(reachable_area(build_world(graded(grade_percent, 0.0)), {}));
  };
  EXPECT_GT(reach(30.0), 38.0);
  EXPECT_GT(reach(-35.0), 38.0);  // 0.35 rad are 36.5 %
  // The front axle, 0.75 m ahead, is on the grade up to the share of the limit.
  const double on_grade = 1.5 * std::tan(kSlopeMaxRad) / 0.45;
  EXPECT_NEAR(reach(45.0), 15.0 - 0.75 + on_grade, kCellAndSquare);
  EXPECT_LT(reach(-60.0), 15.8);
}

TEST(ReachableArea, EndsAtAStepThatTheVehicleDoesNotClimb) {
  const auto reach = [](double step_m) {
    return farthest_x(reachable_area(build_world(graded(0.0, step_m)), {}));
  };
  EXPECT_GT(reach(0.15), 38.0);
  EXPECT_GT(reach(-0.15), 38.0);
  EXPECT_LT(reach(0.3), 15.0);
  EXPECT_LT(reach(-0.3), 15.0);
}

TEST(ReachableArea, EndsAtACrossSlopeThatIsTooSteep) {
  WorldDescription description = graded(0.0, 0.0);
  // To the right of the centre line the ground is level.
  const auto with = [&](double grade) {
    description.heights.profile_m = {0.0, 0.0, 40.0, 40.0 * grade};
    description.heights.heading_rad = 1.5707963;
    description.heights.grade = "sudden";
    return reachable_area(build_world(description), {}).cells.size();
  };
  EXPECT_GT(with(0.3), 100U);
  EXPECT_EQ(with(1.0), 0U);
}

TEST(IsPassable, BelowTheBellyAboveTheTopAndShallow) {
  const Vehicle vehicle;  // 1.0 m high, belly at 0.3 m, 0.25 m of water
  Obstacle obstacle = block(0.0, 1.0, 0.0, 1.0);
  EXPECT_FALSE(is_passable(obstacle, 0.0, vehicle));
  obstacle.z_high_m = 0.25;
  EXPECT_TRUE(is_passable(obstacle, 0.0, vehicle));
  EXPECT_FALSE(is_passable(obstacle, -0.1, vehicle));
  obstacle.z_low_m = 1.05;
  obstacle.z_high_m = 2.0;
  EXPECT_TRUE(is_passable(obstacle, 0.0, vehicle));
  EXPECT_FALSE(is_passable(obstacle, 0.1, vehicle));
  obstacle = {
      .kind = PartKind::kWater, .name = "", .outline = {}, .z_low_m = -0.2, .z_high_m = 0.0};
  EXPECT_TRUE(is_passable(obstacle, 0.0, vehicle));
  obstacle.z_low_m = -0.3;
  EXPECT_FALSE(is_passable(obstacle, 0.0, vehicle));
  obstacle.kind = PartKind::kFloor;  // a pit or mud: wheels climb, and sink, by 0.2 m
  EXPECT_FALSE(is_passable(obstacle, 0.0, vehicle));
  obstacle.z_low_m = -0.15;
  EXPECT_TRUE(is_passable(obstacle, 0.0, vehicle));
}

}  // namespace
}  // namespace adit
