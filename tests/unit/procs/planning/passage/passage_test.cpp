// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/passage/passage.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "common/types/body_outline.hpp"
#include "procs/planning/planning.hpp"

namespace adit {
namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();
constexpr double kBendRadiusM = 20.0;  // of the bend
constexpr double kWallM = 0.03;        // thickness of the walls
constexpr double kPartErrorM = 0.018;  // half the diagonal of a part: points lie anywhere in it

/// A tunnel through the origin along `heading_rad`, which bends to the left if `bent`.
struct StraightOrBentTunnel {
  double width_m = 1.5;
  double heading_rad = 0.0;
  bool bent = false;
  double edge_x_m = 1e3;  ///< from here on the left side is closed
  double edge_y_m = 0.0;  ///< as far as this
  float height_m = 1.0F;  ///< of the walls

  /// Whether a point lies in what closes the left side, and how far from its surface.
  [[nodiscard]] bool is_closed(const Eigen::Vector2d& p) const {
    return p.x() >= edge_x_m && p.y() >= edge_y_m;
  }
  [[nodiscard]] bool is_edge(const Eigen::Vector2d& p) const {
    return is_closed(p) && std::min(p.x() - edge_x_m, p.y() - edge_y_m) < kWallM;
  }

  /// Offset of a point from the centre line, positive to the left [m].
  [[nodiscard]] double offset_m(const Eigen::Vector2d& p) const {
    const Eigen::Vector2d left(-std::sin(heading_rad), std::cos(heading_rad));
    if (!bent) return p.dot(left);
    return kBendRadiusM - (p - kBendRadiusM * left).norm();
  }
};

/// The terrain map of the tunnel: regions of 3 × 3 cells enlarge the walls.
TerrainMap terrain_of_tunnel(const StraightOrBentTunnel& tunnel) {
  TerrainMap map;
  map.p_level_corner = {-4.05, -8.05};
  map.cells = Grid2<TerrainCell>(160, 160);
  const double half_m = tunnel.width_m / 2.0;
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    const Eigen::Vector2i at = map.cells.cell(i);
    const Eigen::Vector2d corner = map.p_level_corner + map.cell_m * at.cast<double>();
    TerrainCell& cell = map.cells[i];
    cell.clearance_m = static_cast<float>(kNoLimit);
    for (int part = 0; part < CellParts::kCount; ++part) {
      const Eigen::Vector2d p = corner + map.cell_m * CellParts::centre(part);
      const double beside_m = std::abs(tunnel.offset_m(p)) - half_m;
      if (beside_m < kWallM && (!tunnel.is_closed(p) || tunnel.is_edge(p)))
        cell.ground = Ground::kObserved;
      if ((beside_m >= 0.0 && beside_m < kWallM) || (beside_m < 0.0 && tunnel.is_edge(p)))
        cell.obstacle_parts |= static_cast<std::uint16_t>(1U << static_cast<unsigned>(part));
    }
  }
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    const Eigen::Vector2i at = map.cells.cell(i);
    for (int k = 0; k < 9; ++k) {
      const TerrainCell near = map.cells.get(at + Eigen::Vector2i(k % 3 - 1, k / 3 - 1));
      if (near.obstacle_parts != 0)
        map.cells[i].coefficient_m = map.cells[i].high_m = tunnel.height_m;
    }
    map.cells[i].count = 20;
  }
  return map;
}

PlannedPath plan_along(const StraightOrBentTunnel& tunnel, bool behind = false,
                       const PlanningParams& params = {}) {
  PlanGoal goal;
  goal.distance_m = 7.0;
  goal.T_odom_goal.theta = tunnel.heading_rad;
  const Pose2 robot{0.0, 0.0, wrap_angle(tunnel.heading_rad + (behind ? std::numbers::pi : 0.0))};
  return Planning(params).plan(terrain_of_tunnel(tunnel), goal, robot);
}

/// Least distance of the body on the path to the true walls.
double true_clearance_m(const PlannedPath& path, const StraightOrBentTunnel& tunnel) {
  const Eigen::Vector2d half = body_outline(Vehicle{}).high();
  double least_m = kNoLimit;
  for (const PathPoint& point : path.points) {
    for (const double x : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
      for (const double y : {-1.0, 1.0}) {
        const Eigen::Vector2d p = point.T_odom_body * Eigen::Vector2d(x * half.x(), y * half.y());
        least_m = std::min(least_m, tunnel.width_m / 2.0 - std::abs(tunnel.offset_m(p)));
      }
    }
  }
  return least_m;
}

TEST(Passage, KeepsToTheMiddleAtAnyHeading) {
  for (const double heading_rad : {0.0, 0.1, 0.3}) {
    const StraightOrBentTunnel tunnel{1.32, heading_rad};
    const PlannedPath path = plan_along(tunnel);
    ASSERT_EQ(path.outcome, PlanOutcome::kFound) << heading_rad << ": " << path.reason;
    EXPECT_GT(path.reached_m, 4.0);
    EXPECT_GT(true_clearance_m(path, tunnel), 0.06 - 2.0 * kPartErrorM);
  }
}

TEST(Passage, KeepsMoreRoomToWhatTheLevelLasersDoNotSee) {
  PlanningParams params;
  params.lasers.front.height_m = 0.6;
  StraightOrBentTunnel tunnel{1.36};
  tunnel.height_m = 0.65F;
  EXPECT_GT(plan_along(tunnel, false, params).reached_m, 4.0);
  tunnel.height_m = 0.55F;
  EXPECT_LT(plan_along(tunnel, false, params).reached_m, 1.3);  // as near as at the start
  tunnel.width_m = 1.46;
  const PlannedPath path = plan_along(tunnel, false, params);
  ASSERT_EQ(path.outcome, PlanOutcome::kFound) << path.reason;
  EXPECT_GT(true_clearance_m(path, tunnel), 0.13 - 2.0 * kPartErrorM);
}

TEST(Passage, FollowsABend) {
  const StraightOrBentTunnel tunnel{1.4, 0.0, true};
  const PlannedPath path = plan_along(tunnel);
  ASSERT_EQ(path.outcome, PlanOutcome::kFound) << path.reason;
  EXPECT_GT(path.reached_m, 4.0);
  // The body takes its length squared over eight radii of the width.
  EXPECT_GT(true_clearance_m(path, tunnel), 0.1 - 0.036 - 2.0 * kPartErrorM);
}

/// Past the corner of a car that stands 0.1 to 0.4 m in the lane of the robot, with room beside it:
/// a path that the corner leaves no room for ends before it.
TEST(Passage, KeepsADistanceFromACornerWhereThereIsRoom) {
  const Eigen::Vector2d half = body_outline(Vehicle{}).high();
  PlanningParams params;
  params.search.expansions_max = 1;  // the lattice finds none
  int past_the_corner = 0;
  for (const double edge_x_m : {1.5, 1.7, 1.9, 2.2, 2.6}) {
    for (const double edge_y_m : {0.2, 0.3, 0.4, 0.5}) {
      const StraightOrBentTunnel tunnel{2.9, 0.0, false, edge_x_m, edge_y_m};
      const PlannedPath path = plan_along(tunnel, false, params);
      for (const PathPoint& point : path.points) {
        const Eigen::Vector2d corner =
            point.T_odom_body.inverse() * Eigen::Vector2d(edge_x_m, edge_y_m);
        const Eigen::Vector2d apart = (corner.cwiseAbs() - half).cwiseMax(0.0);
        EXPECT_GT(apart.norm(), 0.08 - 2.0 * kPartErrorM) << edge_x_m << ' ' << edge_y_m;
        past_the_corner += corner.x() < 0.0 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(past_the_corner, 0);
}

TEST(Passage, LeadsInReverseWithTheRear) {
  const StraightOrBentTunnel tunnel{1.32, 0.1};
  const PlannedPath path = plan_along(tunnel, true);
  ASSERT_EQ(path.outcome, PlanOutcome::kFound) << path.reason;
  EXPECT_TRUE(std::ranges::all_of(path.points, &PathPoint::reverse));
  EXPECT_GT(true_clearance_m(path, tunnel), 0.06 - 2.0 * kPartErrorM);
}

/// Raises the ground on one side of the centre line of a tunnel along x.
TerrainMap with_raised_side(TerrainMap map, double side, float height_m) {
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    const Eigen::Vector2i at = map.cells.cell(i);
    TerrainCell& cell = map.cells[i];
    if (side * map.centre(at.x(), at.y()).y() < 0.2 || cell.coefficient_m > 0.2F) continue;
    cell.high_m = cell.coefficient_m = height_m;
  }
  return map;
}

TEST(Passage, EndsWhereABodyThatLeansDoesNotFit) {
  const StraightOrBentTunnel tunnel{1.32};
  PlanGoal goal;
  goal.distance_m = 7.0;
  const PlannedPath path =
      Planning(PlanningParams{})
          .plan(with_raised_side(terrain_of_tunnel(tunnel), 1.0, 0.15F), goal, {});
  EXPECT_NE(path.outcome, PlanOutcome::kFound);  // 0.12 m of room, 0.16 m of lean
}

TEST(Passage, IsNoneWhereTheBodyDoesNotFit) {
  for (const double width_m : {1.0, 1.15, 1.2}) {
    EXPECT_NE(plan_along({width_m, 0.0}).outcome, PlanOutcome::kFound) << width_m;
  }
}

}  // namespace
}  // namespace adit
