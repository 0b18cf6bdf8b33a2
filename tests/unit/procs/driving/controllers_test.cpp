// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/driving/controllers.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "common/geometry/pose2.hpp"
#include "tests/support/drives/test_paths.hpp"

namespace adit {
namespace {

constexpr double kStepM = 1e-4;

/// The error relative to a circle through the origin, tangent to x; a line for zero curvature.
PathTrackingError error_beside(double path_curvature_1_m, const Pose2& pose) {
  if (path_curvature_1_m == 0.0) return {pose.y, pose.theta};
  const double radius = 1.0 / path_curvature_1_m;
  const Eigen::Vector2d from_centre = pose.translation() - Eigen::Vector2d(0.0, radius);
  const double side = std::copysign(1.0, radius);
  const double heading = std::atan2(side * from_centre.x(), -side * from_centre.y());
  return {radius - side * from_centre.norm(), angle_diff(pose.theta, heading)};
}

/// The lateral error after a distance, of a point that is steered without limits.
double lateral_after(double distance_m, Pose2 pose, double path_curvature_1_m, double direction,
                     const LateralParams& params) {
  for (double s_m = 0.0; s_m < distance_m - kStepM / 2.0; s_m += kStepM) {
    const double curvature = lateral_curvature(error_beside(path_curvature_1_m, pose),
                                               path_curvature_1_m, direction, params);
    pose = pose * along_arc(direction * kStepM, direction * kStepM * curvature);
  }
  return error_beside(path_curvature_1_m, pose).lateral_m;
}

/// The solution of y'' + 2 ζ ω y' + ω² y = 0.
double linear_solution(double distance_m, double y, double slope, const LateralParams& params) {
  const double omega = 1.0 / params.response_m;
  const double decay = std::exp(-params.damping * omega * distance_m);
  if (params.damping == 1.0) return decay * (y + (slope + omega * y) * distance_m);
  const double mu = omega * std::sqrt(std::abs(1.0 - params.damping * params.damping));
  const double b = (slope + params.damping * omega * y) / mu;
  if (params.damping < 1.0)
    return decay * (y * std::cos(mu * distance_m) + b * std::sin(mu * distance_m));
  return decay * (y * std::cosh(mu * distance_m) + b * std::sinh(mu * distance_m));
}

TEST(LateralControl, MakesErrorsDecayByTheLinearEquation) {
  const Pose2 start{0.0, 0.2, 0.3};
  for (const double damping : {0.6, 1.0, 1.5}) {
    const LateralParams params{0.7, damping};
    for (const double path_curvature : {0.0, 0.4, -0.4}) {
      for (const double direction : {1.0, -1.0}) {
        const PathTrackingError error = error_beside(path_curvature, start);
        const double slope = direction * std::sin(error.heading_rad);
        for (const double distance_m : {0.3, 0.8, 2.0, 4.0}) {
          EXPECT_NEAR(lateral_after(distance_m, start, path_curvature, direction, params),
                      linear_solution(distance_m, error.lateral_m, slope, params),
                      5e-5);  // the curvature is constant over a step
        }
      }
    }
  }
}

TEST(LateralControl, IsMirrorSymmetric) {
  const LateralParams params;
  for (const double direction : {1.0, -1.0}) {
    EXPECT_DOUBLE_EQ(lateral_curvature({0.1, -0.2}, 0.3, direction, params),
                     -lateral_curvature({-0.1, 0.2}, -0.3, direction, params));
  }
}

TEST(LateralControl, MirrorsTheHeadingErrorInReverse) {
  const LateralParams params;
  EXPECT_DOUBLE_EQ(lateral_curvature({0.1, 0.2}, 0.3, 1.0, params),
                   lateral_curvature({0.1, -0.2}, 0.3, -1.0, params));
}

TEST(LateralControl, SteersBackToThePath) {
  const LateralParams params;
  EXPECT_LT(lateral_curvature({0.1, 0.0}, 0.0, 1.0, params), 0.0);   // to the right
  EXPECT_LT(lateral_curvature({0.1, 0.0}, 0.0, -1.0, params), 0.0);  // the tail to the right, too
  EXPECT_DOUBLE_EQ(lateral_curvature({0.0, 0.0}, 0.25, 1.0, params), 0.25);
}

TEST(LateralControl, IsFiniteForAnyError) {
  EXPECT_TRUE(std::isfinite(lateral_curvature({2.0, 1.6}, 0.625, 1.0, {})));
}

PathRun run_of(const PlannedPath& path) {
  return split_into_runs(path.points, SteeredPoint({})).front();
}

TEST(PurePursuitCurvature, IsTheCurvatureOfTheCircleOnIt) {
  for (const double curvature : {0.5, -0.3}) {
    const PathRun ahead = run_of(TestPathBuilder({}, {}, 0.02).forward(5.0, curvature).path());
    const PathRun back = run_of(TestPathBuilder({}, {}, 0.02).back(5.0, curvature).path());
    for (const double s_m : {1.0, 3.0, 4.9}) {  // the last target is beyond the end
      EXPECT_NEAR(pursuit_curvature(ahead, s_m, ahead.at(s_m), 0.4, {}), curvature, 1e-3);
      EXPECT_NEAR(pursuit_curvature(back, s_m, back.at(s_m), -0.4, {}), curvature, 1e-3);
    }
  }
}

TEST(PurePursuitCurvature, LooksFartherAheadAtHigherSpeed) {
  const PathRun run = run_of(TestPathBuilder({}).forward(5.0).path());
  const PurePursuitParams params{2.0, 0.6, 1.2};
  const Pose2 beside{1.0, 0.1, 0.0};
  const auto expected = [](double ahead_m) { return -0.2 / (0.01 + ahead_m * ahead_m); };
  EXPECT_NEAR(pursuit_curvature(run, 1.0, beside, 0.1, params), expected(0.6), 1e-9);
  EXPECT_NEAR(pursuit_curvature(run, 1.0, beside, 0.4, params), expected(0.8), 1e-9);
  EXPECT_NEAR(pursuit_curvature(run, 1.0, beside, 2.0, params), expected(1.2), 1e-9);
}

}  // namespace
}  // namespace adit
