// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/planning.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/types/body_outline.hpp"
#include "procs/planning/c_space/footprint.hpp"
#include "tests/support/robots/chamfered_vehicle.hpp"
#include "tests/support/worlds/terrain_scenes.hpp"

namespace adit {
namespace {

using Reason = BlockingCell::Reason;

PlannedPath plan(const TerrainMap& terrain, const PlanGoal& goal = {}, const Pose2& robot = {},
                 const PlanningParams& params = {}) {
  return Planning(params).plan(terrain, goal, robot);
}

PlanGoal goal_to(const Pose2& pose) {
  PlanGoal goal;
  goal.kind = PlanGoal::Kind::kToPose;
  goal.T_odom_goal = pose;
  return goal;
}

TerrainMap corridor_with(const TerrainCell& cell, const Eigen::Vector2d& low,
                         const Eigen::Vector2d& high) {
  TerrainMap terrain = terrain_of(CorridorScene{});
  paint_box(terrain, cell, low, high);
  return terrain;
}

int count(const PlannedPath& path, Reason reason) {
  return static_cast<int>(std::count_if(path.blocking.begin(), path.blocking.end(),
                                        [&](const auto& cell) { return cell.reason == reason; }));
}

/// Number of contacts of the footprint with points of lethal cells along a path.
int contacts(const PlannedPath& path, const TerrainMap& terrain, const Vehicle& vehicle) {
  const std::vector<ConvexPolygon> body{body_outline(vehicle)};
  const auto wheels = wheel_tracks(vehicle);
  int count = 0;
  for (const PathPoint& point : path.points) {
    const Pose2 T_body_level = (terrain.T_odom_level.inverse() * point.T_odom_body).inverse();
    for (int row = 0; row < terrain.cells.rows(); ++row) {
      for (int column = 0; column < terrain.cells.columns(); ++column) {
        const auto reason = lethal_reason(terrain.cells.at({column, row}), vehicle, {});
        if (!reason || *reason == Reason::kUnknown) continue;
        const bool any = *reason == Reason::kBelly || *reason == Reason::kRoof;
        for (const double dx : {-0.5, 0.0, 0.5}) {
          for (const double dy : {-0.5, 0.0, 0.5}) {
            const Eigen::Vector2d p = T_body_level * (terrain.centre(column, row) +
                                                      terrain.cell_m * Eigen::Vector2d(dx, dy));
            if (any_contains(any ? body : wheels, p)) ++count;
          }
        }
      }
    }
  }
  return count;
}

TEST(Planning, DrivesStraightDownAFreeCorridor) {
  PlanGoal goal;
  goal.distance_m = 12.0;
  const PlannedPath path = plan(terrain_of(CorridorScene{}, 30.0), goal);
  ASSERT_EQ(path.outcome, PlanOutcome::kFound);
  EXPECT_NEAR(path.reached_m, 12.0, 0.05 + 1e-9);  // half a cell
  EXPECT_TRUE(path.blocking.empty());
  for (const PathPoint& point : path.points) {
    EXPECT_NEAR(point.T_odom_body.y, 0.0, 0.05 + 1e-9);  // half a cell
    EXPECT_FALSE(point.reverse);
    EXPECT_NEAR(point.clearance_m, 1.4, 0.15);  // of 2 m, in cells
  }
}

TEST(Planning, KeepsToTheCurvatureOfTheVehicle) {
  const double spacing = PlanningParams{}.point_spacing_m;
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    const PlannedPath path = plan(terrain_of(random_corridor(seed)));
    ASSERT_EQ(path.outcome, PlanOutcome::kFound) << seed;
    for (std::size_t i = 1; i < path.points.size(); ++i) {
      const PathPoint& here = path.points[i - 1];
      const Pose2 T_here_next = between(here.T_odom_body, path.points[i].T_odom_body);
      const double step_m = T_here_next.translation().norm();
      EXPECT_LE(step_m, 1.5 * spacing);
      EXPECT_EQ(T_here_next.x < -1e-9, here.reverse && step_m > 1e-9);
      // An arc turns by its length times its curvature; a segment may be part arc, part line.
      EXPECT_LE(std::abs(T_here_next.theta), 1.01 * step_m / Vehicle{}.turning_radius_m + 1e-9);
      EXPECT_LE(std::abs(here.curvature_1_m), 1.0 / Vehicle{}.turning_radius_m + 1e-9);
      EXPECT_GE(path.points[i].cost, here.cost);
    }
  }
}

TEST(Planning, TouchesNoLethalGround) {
  for (std::uint32_t seed = 100; seed < 130; ++seed) {
    const TerrainMap terrain = terrain_of(random_corridor(seed));
    const PlannedPath path = plan(terrain);
    ASSERT_EQ(path.outcome, PlanOutcome::kFound) << seed;
    EXPECT_EQ(contacts(path, terrain, Vehicle{}), 0) << seed;
  }
}

/// Of a tunnel with a right-angled bend to the left, in steps of a cell: the least in which a path
/// round the bend is found [m].
double least_width_of_bend_m(const Vehicle& vehicle) {
  PlanningParams params;
  params.vehicle = vehicle;
  const Pose2 beyond{3.0, 4.5, std::numbers::pi / 2.0};
  for (double width_m = 3.0; width_m > 1.2; width_m -= 0.1) {
    TerrainMap terrain = even_ground(14.0);
    const TerrainCell rock = obstacle_cell(1.0);
    const double half_m = 0.5 * width_m;
    paint_box(terrain, rock, {-7.0, -7.0}, {7.0, -half_m});
    paint_box(terrain, rock, {3.0 + half_m, -7.0}, {7.0, 7.0});
    paint_box(terrain, rock, {-7.0, half_m}, {3.0 - half_m, 7.0});
    const PlannedPath path = plan(terrain, goal_to(beyond), {}, params);
    if (path.outcome != PlanOutcome::kFound) return width_m + 0.1;
    EXPECT_EQ(contacts(path, terrain, vehicle), 0) << width_m;
  }
  return 0.0;
}

/// By hand, without cells: the outer corner of the rectangle runs at a radius of
/// hypot(1.6 + 0.6, 1.2) = 2.51 m, those of the cut one at 2.32 m, so 0.18 m are saved.
TEST(Planning, TurnsInANarrowerTunnelWithCutCorners) {
  const double rectangle_m = least_width_of_bend_m({});
  const double cut_m = least_width_of_bend_m(chamfered({}, 0.45));
  EXPECT_GT(cut_m, 1.5);
  EXPECT_NEAR(rectangle_m - cut_m, 0.18, 0.1);
}

TEST(Planning, PlansTheMirrorImageInAMirroredScene) {
  const double centre_m = 0.05;  // of a cell; maps are mirrored about the centre of a row
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    TerrainMap terrain = terrain_of(random_corridor(seed), 20.1);
    terrain.p_level_corner.y() = -10.05;
    const PlannedPath path = plan(terrain, {}, {centre_m, 0.0, 0.0});
    const PlannedPath image = plan(mirrored(terrain), {}, {centre_m, 0.0, 0.0});
    ASSERT_EQ(path.points.size(), image.points.size()) << seed;
    for (std::size_t i = 0; i < path.points.size(); ++i) {
      EXPECT_NEAR(path.points[i].T_odom_body.x, image.points[i].T_odom_body.x, 1e-9);
      EXPECT_NEAR(path.points[i].T_odom_body.y, -image.points[i].T_odom_body.y, 1e-9);
      EXPECT_NEAR(path.points[i].curvature_1_m, -image.points[i].curvature_1_m, 1e-9);
    }
  }
}

TEST(Planning, IsDeterministic) {
  Planning planning(PlanningParams{});
  const TerrainMap terrain = terrain_of(random_corridor(5));
  EXPECT_EQ(planning.plan(terrain, {}, {}), planning.plan(terrain, {}, {}));
}

TEST(Planning, PassesAGapOf1Point8Metres) {
  TerrainMap terrain = corridor_with(obstacle_cell(1.0), {4.0, -2.0}, {4.3, -0.9});
  paint_box(terrain, obstacle_cell(1.0), {4.0, 0.9}, {4.3, 2.0});
  const PlannedPath path = plan(terrain);
  EXPECT_EQ(path.outcome, PlanOutcome::kFound);
  EXPECT_GT(path.reached_m, 6.0);
}

TEST(Planning, StraddlesRails) {
  CorridorScene scene;
  scene.rails = true;
  const PlannedPath path = plan(terrain_of(scene), {}, {0.0, 0.4, 0.0});
  ASSERT_EQ(path.outcome, PlanOutcome::kFound);
  // The wheels are as far apart as the rails: the robot leaves the rails as soon as it can.
  const double gauge = 0.9;
  int on_rails = 0;
  for (const PathPoint& point : path.points) {
    const double left = point.T_odom_body.y + Vehicle{}.track_m / 2.0;
    const double right = point.T_odom_body.y - Vehicle{}.track_m / 2.0;
    const bool on_rail =
        std::min({std::abs(left - gauge / 2.0), std::abs(right + gauge / 2.0),
                  std::abs(left + gauge / 2.0), std::abs(right - gauge / 2.0)}) < 0.1;
    if (on_rail) ++on_rails;
  }
  EXPECT_LT(on_rails, static_cast<int>(path.points.size()) / 3);
}

TEST(Planning, ReportsABeamAcrossTheCorridorAsEvidence) {
  const PlannedPath path = plan(corridor_with(obstacle_cell(0.6), {2.8, -2.0}, {3.0, 2.0}));
  EXPECT_EQ(path.outcome, PlanOutcome::kBlocked);
  EXPECT_TRUE(path.points.empty());
  EXPECT_GT(path.reached_m, 2.8 - 1.2 - 0.35);  // half its length, and the margins
  EXPECT_LT(path.reached_m, 2.8 - 0.6);         // half its width, where it has turned
  EXPECT_GT(count(path, Reason::kBelly), 20);
  for (const BlockingCell& cell : path.blocking) {
    EXPECT_TRUE(std::abs(cell.p_odom.y()) > 1.8 || std::abs(cell.p_odom.x() - 2.9) < 0.11);
  }
  EXPECT_THAT(path.reason, testing::HasSubstr("too high to drive over"));
}

TEST(Planning, ReportsTheReasonOfBlockingCells) {
  const auto across = [](const TerrainCell& cell) {
    return plan(corridor_with(cell, {2.5, -2.0}, {3.5, 2.0}));
  };
  EXPECT_GT(count(across(roofed_cell(0.8)), Reason::kRoof), 10);
  EXPECT_THAT(
      across(roofed_cell(0.8)).blocking,
      testing::Contains(testing::Field(&BlockingCell::height_m, testing::DoubleNear(0.8, 1e-6))));
  TerrainCell wall = obstacle_cell(0.9);
  wall.clearance_m = 1.05F;
  EXPECT_GT(count(across(wall), Reason::kBelly), 10);
  EXPECT_EQ(count(across(wall), Reason::kRoof), 0);
  EXPECT_GT(count(across(unmeasured_cell(Ground::kNoReturn)), Reason::kWater), 10);
  EXPECT_GT(count(across(unmeasured_cell(Ground::kBelowRay)), Reason::kDrop), 10);
  EXPECT_GT(count(across(obstacle_cell(0.22)), Reason::kStep), 10);
}

TEST(Planning, NamesWhatLiesAcrossTheTunnelNotTheRubbleBesideIt) {
  TerrainMap terrain = corridor_with(unmeasured_cell(Ground::kNoReturn), {3.0, -2.0}, {3.2, 2.0});
  for (const double y : {-2.0, 1.0}) {
    paint_box(terrain, obstacle_cell(0.6), {0.8, y}, {3.0, y + 1.0});
  }
  const PlannedPath path = plan(terrain);
  ASSERT_EQ(path.outcome, PlanOutcome::kBlocked);
  EXPECT_GT(count(path, Reason::kBelly), count(path, Reason::kWater));
  EXPECT_THAT(path.reason, testing::HasSubstr("possible water"));
}

/// At its edge some beams pass low over the water, as over a drop.
TEST(Planning, NamesWaterWhereSomeOfItLooksLikeADrop) {
  TerrainMap terrain = corridor_with(unmeasured_cell(Ground::kBelowRay), {3.0, -2.0}, {4.0, 2.0});
  EXPECT_THAT(plan(terrain).reason, testing::HasSubstr("a drop"));
  for (double y = -2.0; y < 2.0; y += 0.3) {
    paint_box(terrain, unmeasured_cell(Ground::kNoReturn), {3.0, y}, {4.0, y + 0.1});
  }
  const PlannedPath path = plan(terrain);
  ASSERT_EQ(path.outcome, PlanOutcome::kBlocked);
  EXPECT_GT(count(path, Reason::kDrop), count(path, Reason::kWater));
  EXPECT_THAT(path.reason, testing::HasSubstr("possible water"));
}

TEST(Planning, DistinguishesUnobservedGroundFromObstacles) {
  const Eigen::Vector2d low(2.5, -2.0);
  const PlannedPath unknown =
      plan(corridor_with(unmeasured_cell(Ground::kOccluded), low, {5.5, 2.0}));
  EXPECT_EQ(unknown.outcome, PlanOutcome::kUnknown);
  EXPECT_GT(count(unknown, Reason::kUnknown), 10);
  TerrainMap both = corridor_with(unmeasured_cell(Ground::kOccluded), low, {5.5, 2.0});
  paint_box(both, obstacle_cell(1.0), {2.8, -2.0}, {3.0, 2.0});
  EXPECT_EQ(plan(both).outcome, PlanOutcome::kBlocked);
}

/// Ground of which the floor is seen, but not what is above it, is lethal to the body, yet no
/// evidence that the tunnel is closed: at the edge of what a scan shows of a branch it lies across.
TEST(Planning, DistinguishesHiddenHeadroomFromObstacles) {
  constexpr float kHidden = std::numeric_limits<float>::quiet_NaN();
  for (const double to_m : {2.7, 5.5}) {
    TerrainMap hidden = corridor_with(roofed_cell(kHidden), {2.5, -2.0}, {to_m, 2.0});
    EXPECT_EQ(plan(hidden).outcome, PlanOutcome::kUnknown) << to_m;
    paint_box(hidden, unmeasured_cell(Ground::kOccluded), {2.7, -2.0}, {5.5, 2.0});
    EXPECT_EQ(plan(hidden).outcome, PlanOutcome::kUnknown) << to_m;
    paint_box(hidden, obstacle_cell(1.0), {3.0, -2.0}, {3.2, 2.0});
    EXPECT_EQ(plan(hidden).outcome, PlanOutcome::kBlocked) << to_m;
  }
}

TEST(Planning, FindsNoDetourThroughUnobservedGroundBehindIt) {
  // The scan ahead shows a closed tunnel. Unobserved ground behind the robot and behind the walls
  // must not count as a detour.
  CorridorScene scene;
  scene.end_m = 3.0;
  TerrainMap terrain = terrain_of(scene);
  paint_box(terrain, unmeasured_cell(Ground::kNeverObserved), {-10.0, -10.0}, {-1.0, 10.0});
  EXPECT_EQ(plan(terrain).outcome, PlanOutcome::kBlocked);
  // The same with some observed ground of the tunnel behind it.
  terrain = terrain_of(scene);
  paint_box(terrain, unmeasured_cell(Ground::kNeverObserved), {-10.0, -10.0}, {-6.0, 10.0});
  EXPECT_EQ(plan(terrain).outcome, PlanOutcome::kBlocked);
}

TEST(Planning, IsNarrowWhereOnlyMarginsBlock) {
  const auto with_gap = [](double gap_m) {
    TerrainMap terrain = corridor_with(obstacle_cell(1.0), {3.0, gap_m / 2.0}, {4.0, 2.0});
    paint_box(terrain, obstacle_cell(1.0), {3.0, -2.0}, {4.0, -gap_m / 2.0});
    return plan(terrain);
  };
  // The vehicle is 1.2 m wide, plus the kernel margin, in cells of 0.1 m. Obstacles are as wide as
  // in the terrain map, which widens them by 0.1 to 0.2 m on each side.
  EXPECT_EQ(with_gap(1.6).outcome, PlanOutcome::kFound);
  for (const double gap_m : {0.9, 1.1}) {  // of gaps of 1.2 and 1.4 m in the terrain map
    const PlannedPath tight = with_gap(gap_m);
    EXPECT_EQ(tight.outcome, PlanOutcome::kNarrow) << gap_m;
    EXPECT_THAT(tight.reason, testing::HasSubstr("may just fit")) << gap_m;
  }
  EXPECT_EQ(with_gap(0.7).outcome, PlanOutcome::kBlocked);

  const auto below = [](double roof_m) {
    return plan(corridor_with(roofed_cell(roof_m), {2.5, -2.0}, {5.5, 2.0})).outcome;
  };
  EXPECT_EQ(below(1.2), PlanOutcome::kFound);
  EXPECT_EQ(below(1.05), PlanOutcome::kNarrow);
  EXPECT_EQ(below(0.95), PlanOutcome::kBlocked);
}

TEST(Planning, IsBlockedByADropOnlyIfBeamsReachedIntoIt) {
  const auto outcome_over = [](double beams_m) {
    TerrainCell cell = unmeasured_cell(Ground::kBelowRay);
    cell.low_m = static_cast<float>(beams_m);
    return plan(corridor_with(cell, {2.5, -2.0}, {3.5, 2.0})).outcome;
  };
  EXPECT_EQ(outcome_over(0.08), PlanOutcome::kNarrow);   // the height of a rail
  EXPECT_EQ(outcome_over(-0.15), PlanOutcome::kNarrow);  // wheels climb 0.2 m
  EXPECT_EQ(outcome_over(-0.25), PlanOutcome::kBlocked);
}

/// A corridor with a grade along x whose ground behind x = 3 only the beams over it bound, which
/// fall from there with a slope.
PlanOutcome outcome_behind_edge(double grade, double beams) {
  TerrainMap terrain = terrain_of(CorridorScene{});
  for (std::size_t i = 0; i < terrain.cells.size(); ++i) {
    const Eigen::Vector2i at = terrain.cells.cell(i);
    const double x = terrain.centre(at.x(), at.y()).x();
    TerrainCell& cell = terrain.cells[i];
    if (cell.ground != Ground::kObserved) continue;
    const bool hidden = x > 3.0 && cell.coefficient_m < 0.5F;
    const double from_edge_m = std::max(x - 3.0, 0.0);
    if (hidden) cell = unmeasured_cell(Ground::kBelowRay);
    cell.low_m = static_cast<float>(grade * (x - from_edge_m) + beams * from_edge_m);
    if (!hidden) cell.high_m = cell.low_m + cell.coefficient_m;
  }
  return plan(terrain).outcome;
}

TEST(Planning, IsBlockedBehindAnEdgeOnlyIfNoPassableGroundCanLieThere) {
  for (const double grade : {-0.3, 0.0, 0.3}) {
    EXPECT_EQ(outcome_behind_edge(grade, -0.1), PlanOutcome::kNarrow) << grade;
    EXPECT_EQ(outcome_behind_edge(grade, -0.35), PlanOutcome::kNarrow) << grade;
    EXPECT_EQ(outcome_behind_edge(grade, -0.8), PlanOutcome::kBlocked) << grade;
  }
}

/// Seen from 2.8 m before it: the lowest beams pass over its far edge 0.46 m below the floor.
TEST(Planning, IsBlockedByAPitThatIsWideAcrossTheCorridor) {
  TerrainMap terrain = corridor_with(unmeasured_cell(Ground::kBelowRay), {3.8, -2.0}, {5.9, 2.0});
  for (std::size_t i = 0; i < terrain.cells.size(); ++i) {
    const Eigen::Vector2i at = terrain.cells.cell(i);
    if (terrain.cells[i].ground != Ground::kBelowRay) continue;
    terrain.cells[i].low_m = static_cast<float>(-0.22 * (terrain.centre(at.x(), at.y()).x() - 3.8));
  }
  EXPECT_EQ(plan(terrain).outcome, PlanOutcome::kBlocked);
}

TEST(Planning, IsBlockedByAPitWithAnObservedWall) {
  // Beams pass over the pit down to 0.3 m below the floor and meet some of its wall far below;
  // there is room beside it. The wall lowers the mean height of the rim by 0.15 m.
  TerrainCell pit = unmeasured_cell(Ground::kBelowRay);
  pit.low_m = -0.3F;
  TerrainMap terrain = corridor_with(pit, {2.5, -2.0}, {3.5, 2.0});
  TerrainCell wall = obstacle_cell(0.9);
  wall.low_m = -0.9F;
  paint_box(terrain, wall, {2.7, -0.2}, {3.3, 0.2});
  EXPECT_EQ(plan(terrain).outcome, PlanOutcome::kBlocked);
}

TEST(Planning, DoesNotTakeAPocketInAWallForAPassage) {
  // Without margins the robot gets 0.2 m closer to the wall, to a progress of 2.5 m.
  EXPECT_EQ(plan(corridor_with(obstacle_cell(1.0), {3.6, -2.0}, {3.9, 2.0})).outcome,
            PlanOutcome::kBlocked);
}

TEST(Planning, FindsNoPathBelowTheMinimumProgress) {
  const auto end_at = [](double x) {
    return plan(corridor_with(obstacle_cell(1.0), {x, -2.0}, {x + 0.3, 2.0}));
  };
  EXPECT_EQ(end_at(3.5).outcome, PlanOutcome::kBlocked);
  EXPECT_EQ(end_at(4.5).outcome, PlanOutcome::kFound);
}

/// Directly in front of a wall the robot cannot turn and no laser scans the continuation.
TEST(Planning, EndsWhereTheRobotCanContinue) {
  PlanGoal route;
  route.kind = PlanGoal::Kind::kRoute;
  route.route_odom = {{0.0, 0.0}, {10.0, 0.0}};
  const PlannedPath path = plan(corridor_with(obstacle_cell(1.0), {7.0, -2.0}, {7.3, 2.0}), route);
  ASSERT_EQ(path.outcome, PlanOutcome::kFound);
  EXPECT_LT(path.reached_m, 7.0 - 1.2 - 1.5 + 0.2);  // half its length, and the width of a turn
  EXPECT_GT(path.reached_m, 7.0 - 1.2 - 1.5 - 0.8);  // margins, and steps of the check ahead
}

/// The end of a drive is not exact, and the guard does not stop for a roof that is too low.
TEST(Planning, KeepsADistanceToLethalGroundAtTheEndOfAShortPath) {
  PlanGoal route;
  route.kind = PlanGoal::Kind::kRoute;
  route.route_odom = {{0.0, 0.0}, {10.0, 0.0}};
  for (const double roof_x : {4.0, 4.4, 4.8, 5.2}) {
    const PlannedPath path =
        plan(corridor_with(roofed_cell(0.6), {roof_x, -2.0}, {9.0, 2.0}), route);
    ASSERT_EQ(path.outcome, PlanOutcome::kFound) << roof_x;
    EXPECT_LE(path.reached_m, roof_x - 1.2 - 0.4 + 0.1) << roof_x;  // half its length; a cell
    EXPECT_GE(path.reached_m, roof_x - 1.2 - 1.5 - 0.5) << roof_x;
  }
}

TEST(Planning, NeedsNoObservedGroundUnderTheRobot) {
  TerrainMap terrain =
      corridor_with(unmeasured_cell(Ground::kNeverObserved), {-1.5, -0.9}, {1.5, 0.9});
  EXPECT_EQ(plan(terrain).outcome, PlanOutcome::kFound);
}

TEST(Planning, LeavesAStartThatNoiseMakesLethal) {
  const PlannedPath under = plan(corridor_with(obstacle_cell(0.5), {-0.1, 0.3}, {0.1, 0.6}));
  EXPECT_EQ(under.outcome, PlanOutcome::kFound);
  const PlannedPath beside = plan(corridor_with(obstacle_cell(0.5), {-5.0, 0.75}, {0.5, 2.0}));
  EXPECT_EQ(beside.outcome, PlanOutcome::kFound);
}

/// Drops are dilated by 0.3 m, but not under the robot.
TEST(Planning, DoesNotBlockAStartBesideADrop) {
  const TerrainMap terrain =
      corridor_with(unmeasured_cell(Ground::kBelowRay), {-0.5, 0.65}, {0.5, 1.1});
  EXPECT_NE(plan(terrain).outcome, PlanOutcome::kStartBlocked);
}

/// The cell beside a post is an obstacle, too, but the robot stands there.
TEST(Planning, LeavesAStartBesideAPost) {
  const TerrainMap terrain = corridor_with(obstacle_cell(0.5), {-0.4, 0.6}, {-0.1, 0.9});
  const Pose2 half_a_cell_beside{0.0, 0.04, 0.03};
  EXPECT_EQ(plan(terrain, {}, half_a_cell_beside).outcome, PlanOutcome::kFound);
}

TEST(Planning, DoesNotStartWithUnobservedGroundUnderTheWheels) {
  PlanningParams params;
  params.c_space.ground.blind_margin_m = 0.0;
  // The footprint is cleared, but the lattice pose is up to half a cell beside it.
  TerrainMap terrain =
      corridor_with(unmeasured_cell(Ground::kNeverObserved), {-9.0, -2.0}, {9.0, 2.0});
  EXPECT_NE(plan(terrain, {}, {}, params).outcome, PlanOutcome::kFound);
}

TEST(Planning, ReportsARobotOutsideTheMap) {
  for (const double x : {50.0, 1e300, std::nan("")}) {
    const PlannedPath path = plan(terrain_of(CorridorScene{}), {}, {x, 0.0, 0.0});
    EXPECT_EQ(path.outcome, PlanOutcome::kStartBlocked);
    EXPECT_EQ(path.reason, "The robot is not on the terrain map.");
  }
}

TEST(Planning, ReachesAPoseWithinItsTolerances) {
  const GoalParams tolerances;
  for (const Pose2& pose : {Pose2{4.0, 0.8, 0.4}, Pose2{-3.0, 0.0, 0.0}, Pose2{0.0, 0.0, 0.0}}) {
    const PlannedPath path = plan(terrain_of(CorridorScene{}), goal_to(pose));
    ASSERT_EQ(path.outcome, PlanOutcome::kFound);
    const Pose2 error = between(pose, path.points.back().T_odom_body);
    EXPECT_LE(error.translation().norm(), tolerances.tolerance_m + 1e-9);
    EXPECT_LE(std::abs(error.theta), tolerances.heading_tolerance_rad);
  }
}

TEST(Planning, ReversesToAPoseBehindIt) {
  const PlannedPath path = plan(terrain_of(CorridorScene{}), goal_to({-3.0, 0.0, 0.0}));
  ASSERT_EQ(path.outcome, PlanOutcome::kFound);
  EXPECT_TRUE(path.points.front().reverse);
}

/// Goals behind the robot, along a corridor and at a pose.
TEST(Planning, DrivesInReverseToGoalsBehindIt) {
  for (std::uint32_t seed = 0; seed < 3; ++seed) {
    const TerrainMap terrain = terrain_of(random_corridor(seed));
    // The corridor lies behind the robot.
    PlanGoal along;
    const PlannedPath back = plan(terrain, along, {0.0, 0.0, std::numbers::pi});
    ASSERT_EQ(back.outcome, PlanOutcome::kFound) << seed;
    for (const PathPoint& point : back.points) EXPECT_TRUE(point.reverse) << seed;
    const PlannedPath ahead = plan(terrain, along);
    EXPECT_NEAR(back.reached_m, ahead.reached_m, 0.3) << seed;
  }
  const PlannedPath path = plan(even_ground(), goal_to({-6.0, 1.0, 0.0}));
  ASSERT_EQ(path.outcome, PlanOutcome::kFound);
  for (const PathPoint& point : path.points) EXPECT_TRUE(point.reverse);
}

TEST(Planning, PlansInTheOdometryFrame) {
  TerrainMap terrain = terrain_of(random_corridor(3));
  const PlannedPath here = plan(terrain);
  const Pose2 T_odom_level{40.0, -7.0, 2.0};
  terrain.T_odom_level = T_odom_level;
  PlanGoal goal;
  goal.T_odom_goal = T_odom_level;
  const PlannedPath there = plan(terrain, goal, T_odom_level);
  ASSERT_EQ(here.points.size(), there.points.size());
  for (std::size_t i = 0; i < here.points.size(); ++i) {
    const Pose2 moved = T_odom_level * here.points[i].T_odom_body;
    EXPECT_NEAR((moved.translation() - there.points[i].T_odom_body.translation()).norm(), 0, 1e-9);
  }
}

TEST(Planning, RejectsAMapWithoutCellsOrCellSize) {
  EXPECT_THROW(plan(TerrainMap{}), std::invalid_argument);
  TerrainMap terrain = even_ground();
  terrain.cell_m = 0.0;
  EXPECT_THROW(plan(terrain), std::invalid_argument);
}

TEST(Planning, RejectsAShortfallFactorBelowTheCostOfRoughGround) {
  PlanningParams params;
  params.goals.shortfall_factor = 1.0 + params.c_space.rough_factor;
  EXPECT_THROW(Planning{params}, std::invalid_argument);
}

TEST(Planning, StartsAtTheRobot) {
  TerrainMap terrain = terrain_of(CorridorScene{}, 20.1);  // the origin in the middle of a cell
  EXPECT_EQ(plan(terrain).points.front().T_odom_body, (Pose2{0.0, 0.0, 0.0}));
  const Pose2 robot{0.03, -0.04, 0.05};
  EXPECT_EQ(plan(terrain, {}, robot).points.front().T_odom_body, robot);
}

TEST(Planning, KeepsTheBodyOffUnobservedGround) {
  // A wall may stand directly behind the edge of an occluded region.
  TerrainMap terrain = corridor_with(unmeasured_cell(Ground::kOccluded), {4.0, 0.0}, {6.0, 2.0});
  const PlannedPath path = plan(terrain);
  ASSERT_EQ(path.outcome, PlanOutcome::kFound);
  const ConvexPolygon body = body_outline(Vehicle{});
  for (const PathPoint& point : path.points)
    EXPECT_FALSE(body.moved(point.T_odom_body).meets_square({5.0, 1.0}, 0.9));
}

TEST(Planning, AssumesEvenGroundInTheBlindZoneOnlyWhereItContinues) {
  const auto with_step = [](double height_m) {
    TerrainMap terrain =
        corridor_with(unmeasured_cell(Ground::kNeverObserved), {-5.0, -2.0}, {2.0, 2.0});
    for (int row = 0; row < terrain.cells.rows(); ++row) {
      for (int column = 0; column < terrain.cells.columns(); ++column) {
        TerrainCell& cell = terrain.cells.at({column, row});
        if (cell.ground == Ground::kObserved) cell.low_m = static_cast<float>(height_m);
      }
    }
    return terrain;
  };
  EXPECT_EQ(plan(with_step(0.0)).outcome, PlanOutcome::kFound);
  EXPECT_EQ(plan(with_step(0.25)).outcome, PlanOutcome::kUnknown);
  EXPECT_EQ(plan(with_step(-0.25)).outcome, PlanOutcome::kUnknown);
}

}  // namespace
}  // namespace adit
