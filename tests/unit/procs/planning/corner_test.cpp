// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Drives around tunnel corners with scans of the front laser only, one scan after each path.
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "procs/planning/planning.hpp"
#include "tests/support/worlds/terrain_scenes.hpp"

namespace adit {
namespace {

constexpr double kLaserM = 1.0;   // ahead of the centre of the vehicle
constexpr double kRangeM = 12.0;  // on the ground
constexpr double kBlindM = 0.3;   // minimum range
constexpr double kPassedM = 4.0;  // in the other tunnel: the corner is passed
constexpr int kViewpointsMax = 6;

/// A tunnel along x that ends in another one, whose axis runs through the origin at `turn_rad` to
/// the left. Both are `width_m` wide.
struct Corner {
  double width_m;
  double turn_rad;

  [[nodiscard]] Eigen::Vector2d direction() const {
    return {std::cos(turn_rad), std::sin(turn_rad)};
  }
  [[nodiscard]] bool contains(const Eigen::Vector2d& p) const {
    const double lateral_m = std::sin(turn_rad) * p.x() - std::cos(turn_rad) * p.y();
    return std::abs(lateral_m) < width_m / 2.0 || (std::abs(p.y()) < width_m / 2.0 && p.x() <= 0.0);
  }
  /// Whether the front laser of a robot at `T_body` observes a point.
  [[nodiscard]] bool is_observed_from(const Eigen::Vector2d& p, const Pose2& T_body) const {
    const Eigen::Vector2d p_body = T_body.inverse() * p - Eigen::Vector2d(kLaserM, 0.0);
    const double range_m = p_body.norm();
    if (p_body.x() < 0.0 || range_m < kBlindM || range_m > kRangeM) return false;
    const Eigen::Vector2d laser = T_body * Eigen::Vector2d(kLaserM, 0.0);
    for (double distance_m = 0.0; distance_m < range_m; distance_m += 0.05) {
      if (!contains(laser + distance_m / range_m * (p - laser))) return false;
    }
    return true;
  }
};

TerrainMap observed_from(const std::vector<Pose2>& viewpoints, const Corner& corner) {
  TerrainMap terrain = even_ground(28.0);
  terrain.p_level_corner += viewpoints.back().translation();
  paint(terrain, obstacle_cell(1.0), [&](const Eigen::Vector2d& p) { return !corner.contains(p); });
  paint(terrain, unmeasured_cell(Ground::kOccluded), [&](const Eigen::Vector2d& p) {
    if (!corner.contains(p)) return false;
    for (const Pose2& viewpoint : viewpoints) {
      if (corner.is_observed_from(p, viewpoint)) return false;
    }
    return true;
  });
  return terrain;
}

/// The route of exploration around the corner, from the robot.
PlanGoal goal_around(const Corner& corner, const Pose2& robot) {
  PlanGoal goal;
  goal.kind = PlanGoal::Kind::kRoute;
  goal.route_odom.push_back(robot.translation());
  if (robot.x < -0.3 && std::abs(robot.y) < corner.width_m / 2.0) {
    goal.route_odom.emplace_back(0.0, 0.0);
  }
  goal.route_odom.emplace_back(8.0 * corner.direction());
  return goal;
}

class TunnelCorner : public testing::TestWithParam<double> {};

/// Scans are taken 4 m farther back and at the end of each path.
TEST_P(TunnelCorner, IsPassedWithScansOfTheFrontLaserOnly) {
  const Corner corner{2.4, GetParam() / 180.0 * std::numbers::pi};
  for (const double before_m : {7.5, 6.1}) {
    Pose2 robot{-corner.width_m / 2.0 - before_m, 0.0, 0.0};
    std::vector<Pose2> viewpoints{robot * Pose2{-4.0, 0.0, 0.0}};
    std::string reasons;
    while (robot.translation().dot(corner.direction()) < kPassedM &&
           viewpoints.size() < kViewpointsMax) {
      viewpoints.push_back(robot);
      const PlannedPath path =
          Planning(PlanningParams{})
              .plan(observed_from(viewpoints, corner), goal_around(corner, robot), robot);
      reasons += path.reason + " ";
      ASSERT_EQ(path.outcome, PlanOutcome::kFound) << "from " << before_m << " m: " << reasons;
      robot = path.points.back().T_odom_body;
    }
    EXPECT_GE(robot.translation().dot(corner.direction()), kPassedM) << "from " << before_m << " m";
  }
}

INSTANTIATE_TEST_SUITE_P(Degrees, TunnelCorner, testing::Values(65.0, 90.0, 115.0));

}  // namespace
}  // namespace adit
