// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Matches in a smooth corridor with surfaces across it that may be rising ground.
#include <cmath>
#include <optional>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "common/registration/point_to_line.hpp"

namespace adit {
namespace {

constexpr double kSpacingM = 0.06;  // more than that of surfels: each point is one
constexpr double kHalfWidthM = 1.5;

SurfacePoint wall_point(const Eigen::Vector2d& p, const Eigen::Vector2d& normal) {
  SurfacePoint point;
  point.p = p;
  point.normal = normal;
  point.normal_variance = 1e-4;
  point.variance = 1e-4;
  return point;
}

/// The two walls along x, 30 m long.
std::vector<SurfacePoint> side_walls() {
  std::vector<SurfacePoint> points;
  for (double x = -15.0; x < 15.0; x += kSpacingM) {
    points.push_back(wall_point({x, kHalfWidthM}, {0.0, -1.0}));
    points.push_back(wall_point({x, -kHalfWidthM}, {0.0, 1.0}));
  }
  return points;
}

/// A line across the corridor at this x, from y = −1.4 m to 1.4 m, seen at a height.
std::vector<SurfacePoint> contour(double x_m, double z_m = 0.0, std::optional<int> group = {}) {
  std::vector<SurfacePoint> points;
  for (double y = -1.4; y < 1.4; y += kSpacingM) {
    points.push_back(wall_point({x_m, y}, {x_m > 0.0 ? -1.0 : 1.0, 0.0}));
    points.back().z_m = z_m;
    points.back().grade_group = group;
  }
  return points;
}

std::vector<SurfacePoint> operator+(std::vector<SurfacePoint> a,
                                    const std::vector<SurfacePoint>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

SurfelMap reference_of(const std::vector<SurfacePoint>& points) {
  SurfelMap map{SurfelMapParams{}};
  map.insert(points, {}, 0.0);
  return map;
}

/// As wheels give it.
PosePrior prior_at(const Pose2& T_odom_body, double sd_m) {
  PosePrior prior;
  prior.T_odom_body = T_odom_body;
  prior.information = Eigen::Matrix3d::Identity() / (sd_m * sd_m);
  return prior;
}

/// Information of the displacement of a group before the match: the inverse of the mean of
/// (range / laser height)² · (climb² + (pitch · range)²).
double shift_information(const std::vector<SurfacePoint>& group, double climb_m,
                         const PointToLineParams& params = {}) {
  double variance = 0.0;
  for (const SurfacePoint& point : group) {
    const double inverse_grade = point.p.norm() / params.laser_m;
    const double pitch_m = params.pitch_sd_rad * point.p.norm();
    variance += inverse_grade * inverse_grade * (climb_m * climb_m + pitch_m * pitch_m);
  }
  return static_cast<double>(group.size()) / variance;
}

constexpr double kDistanceM = 6.0;  // of the contour ahead
constexpr double kClimbM = 0.02;
constexpr double kLaserM = 0.6;                             // as in PointToLineParams
constexpr double kShiftM = kClimbM * kDistanceM / kLaserM;  // of the contour: 0.2 m

/// The body stands where the reference was observed, but higher, as on a heap: the contour of
/// rising ground ahead is farther by climb / grade.
PointToLineResult climb(std::optional<int> group, const PosePrior& prior) {
  const SurfelMap reference = reference_of(side_walls() + contour(kDistanceM));
  const auto points = side_walls() + contour(kDistanceM + kShiftM, kClimbM, group);
  return match_point_to_line(points, reference, {}, prior, {});
}

TEST(GradeGroups, TakeTheFalseInformationOutOfRisingGround) {
  const PosePrior prior = prior_at({}, 0.05);
  const auto result = climb(0, prior);
  ASSERT_TRUE(result.converged);
  const double expected =
      shift_information(contour(kDistanceM + kShiftM, kClimbM), kClimbM);  // 1 / (0.21 m)²
  EXPECT_NEAR(result.information(0, 0), expected, 0.01 * expected);
  // Two measurements of one length: that of the wheels, and that the ground did not move.
  const double pull_m = -kShiftM * expected / (expected + prior.information(0, 0));
  EXPECT_NEAR(result.T_odom_body.x, pull_m, 0.002);
  EXPECT_NEAR(pull_m, 0.0, 0.02);
  EXPECT_NEAR(result.T_odom_body.y, 0.0, 1e-3);
  EXPECT_NEAR(result.T_odom_body.theta, 0.0, 1e-3);
}

TEST(GradeGroups, AreNecessaryOnRisingGround) {
  const auto result = climb({}, prior_at({}, 0.05));
  EXPECT_NEAR(result.T_odom_body.x, -kShiftM, 0.02);  // as if it were a wall
}

TEST(GradeGroups, MoveIndependentlyOfEachOther) {
  // The ground rises ahead and the roof falls behind: their contours move in opposite directions,
  // and the one behind half as far.
  const SurfelMap reference =
      reference_of(side_walls() + contour(kDistanceM) + contour(-kDistanceM));
  const auto points = side_walls() + contour(kDistanceM + kShiftM, kClimbM, 0) +
                      contour(-kDistanceM - kShiftM / 2.0, kClimbM, 1);
  const auto result = match_point_to_line(points, reference, {}, prior_at({}, 0.02), {});
  EXPECT_NEAR(result.T_odom_body.x, 0.0, 0.01);
  EXPECT_NEAR(result.T_odom_body.theta, 0.0, 1e-3);
}

TEST(GradeGroups, StillConstrainThePoseBesideAnObliqueRoof) {
  // Across the corridor the side walls do, whatever the direction in which the group moved.
  const SurfelMap reference = reference_of(side_walls() + contour(kDistanceM));
  auto points = side_walls() + contour(kDistanceM, kClimbM, 0);
  for (SurfacePoint& point : points) {
    if (!point.grade_group) continue;
    point.p.y() += 0.1;
    point.normal = Eigen::Vector2d(-1.0, 0.2).normalized();
  }
  const auto result = match_point_to_line(points, reference, {}, prior_at({}, 0.05), {});
  EXPECT_NEAR(result.T_odom_body.y, 0.0, 0.002);
  EXPECT_NEAR(result.T_odom_body.theta, 0.0, 1e-3);
}

TEST(GradeGroups, ConstrainAlongTheCorridorAtShortRangeAndConstantHeight) {
  constexpr double kNearM = 3.0;
  const Pose2 truth{0.08, 0.0, 0.0};
  const auto group = contour(kNearM - truth.x, 0.0, 0);
  const SurfelMap reference = reference_of(side_walls() + contour(kNearM));
  const auto result = match_point_to_line(side_walls() + group, reference, {}, {}, {});
  ASSERT_TRUE(result.converged);
  EXPECT_NEAR(result.T_odom_body.x, truth.x, 0.001);
  const double expected = shift_information(group, 0.0);  // of 3 mrad · 5 m: 0.017 m
  EXPECT_NEAR(result.information(0, 0), expected, 0.01 * expected);
  const auto degenerate = match_point_to_line(side_walls(), reference, {}, {}, {});
  EXPECT_GT(result.information(0, 0), 1e3 * degenerate.information(0, 0));
}

TEST(GradeGroups, AreWallsWhereTheReferenceIsSteep) {
  SurfelMap reference = reference_of(side_walls() + contour(kDistanceM));
  reference.insert(side_walls() + contour(kDistanceM, 0.4), {}, 0.0);
  const PosePrior prior = prior_at({}, 0.05);
  const auto match = [&](std::optional<int> group) {
    return match_point_to_line(side_walls() + contour(kDistanceM - 0.1, kClimbM, group), reference,
                               {}, prior, {});
  };
  const auto grouped = match(0);
  const auto plain = match({});
  EXPECT_NEAR(grouped.T_odom_body.x, 0.1, 0.005);
  EXPECT_EQ(grouped.T_odom_body, plain.T_odom_body);
  EXPECT_EQ(grouped.information, plain.information);
}

TEST(GradeGroups, AloneMakeTheMatchDependOnHeightsBeyondTheLean) {
  const SurfelMap reference = reference_of(side_walls() + contour(kDistanceM));
  const auto match = [&](double z_m, double lean_sd, std::optional<int> group) {
    auto points = side_walls() + contour(kDistanceM - 0.1, z_m, group);
    for (SurfacePoint& point : points) point.lean_sd = lean_sd;
    return match_point_to_line(points, reference, {}, {}, {});
  };
  const auto level = match(0.0, 0.0, {});
  const auto high = match(0.3, 0.0, {});
  EXPECT_EQ(high.T_odom_body, level.T_odom_body);
  EXPECT_EQ(high.information, level.information);
  const double along = level.information(0, 0);
  EXPECT_LT(match(0.3, 0.2, {}).information(0, 0), 0.5 * along);  // 0.06 m against 0.014 m
  EXPECT_LT(match(0.3, 0.0, 0).information(0, 0), 0.01 * along);
}

}  // namespace
}  // namespace adit
