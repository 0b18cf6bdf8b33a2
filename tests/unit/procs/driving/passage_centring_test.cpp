// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/driving/passage_centring.hpp"

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace adit {
namespace {

Vehicle vehicle() {
  Vehicle vehicle;
  vehicle.width_m = 1.2;
  vehicle.length_m = 2.4;
  return vehicle;
}

PathRun straight_run(bool reverse = false) {
  const double theta = reverse ? std::acos(-1.0) : 0.0;  // of a body that moves along x
  return {{{0.0, {0.0, 0.0, theta}, 0.05}, {10.0, {10.0, 0.0, theta}, 0.05}}, reverse};
}

/// Points of both walls, 1 cm apart, in the view of a laser at x; with errors of 5 mm.
std::vector<Eigen::Vector2d> walls(double right_y_m, double left_y_m, double from_x_m,
                                   double to_x_m) {
  std::mt19937 random(1);
  std::normal_distribution<double> error_m(0.0, 0.005);
  std::vector<Eigen::Vector2d> points;
  for (double x = from_x_m; x <= to_x_m; x += 0.01) {
    points.emplace_back(x, right_y_m + error_m(random));
    points.emplace_back(x, left_y_m + error_m(random));
  }
  points.emplace_back(Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN()));
  return points;
}

TEST(PassageCentring, MovesThePathToTheMiddleOfANarrowPassage) {
  PassageCentring centring(vehicle(), {});
  // 1.3 m wide, its middle 3 cm to the left of the path.
  centring.add(walls(-0.62, 0.68, 0.9, 4.5), straight_run(), 0.0);
  EXPECT_NEAR(centring.offset_m(0.0), 0.03, 0.004);  // errors of 5 mm
  EXPECT_NEAR(centring.slope(0.0), 0.0, 1e-9);
}

TEST(PassageCentring, IsToTheLeftOfTheBodyInReverse) {
  PassageCentring centring(vehicle(), {});
  centring.add(walls(-0.62, 0.68, 0.9, 4.5), straight_run(true), 0.0);
  EXPECT_NEAR(centring.offset_m(0.0), -0.03, 0.004);
}

TEST(PassageCentring, LeavesThePathWhereThereIsRoomOrOneWallOnly) {
  for (const auto& points : {walls(-0.7, 0.85, 0.9, 4.5), walls(-0.61, 1.5, 0.9, 4.5),
                             walls(-0.61, 3.0, 0.9, 4.5), std::vector<Eigen::Vector2d>{}}) {
    PassageCentring centring(vehicle(), {});
    centring.add(points, straight_run(), 0.0);
    EXPECT_EQ(centring.offset_m(0.0), 0.0);
    EXPECT_EQ(centring.offset_m(1.4), 0.0);
  }
}

TEST(PassageCentring, MovesNoFartherThanItsLimit) {
  PassageCentring centring(vehicle(), {.clearance_m = 0.1, .offset_max_m = 0.02});
  centring.add(walls(-0.55, 0.75, 0.9, 4.5), straight_run(), 0.0);
  EXPECT_DOUBLE_EQ(centring.offset_m(0.0), 0.02);
}

TEST(PassageCentring, IsContinuousAndItsSlopeIsItsDerivative) {
  PassageCentring centring(vehicle(), {});
  const PathRun run = straight_run();
  for (double s = 0.0; s < 6.0; s += 0.02) {  // the walls are at an angle of 0.02 from x = 3 on
    std::vector<Eigen::Vector2d> points = walls(-0.65, 0.65, s + 0.9, s + 4.0);
    for (Eigen::Vector2d& p : points) p.y() += 0.02 * std::max(0.0, p.x() - 3.0);
    centring.add(points, run, s);
  }
  double before_m = centring.offset_m(0.0);
  for (double s = 0.01; s < 6.0; s += 0.01) {
    const double offset_m = centring.offset_m(s);
    EXPECT_NEAR(offset_m, before_m, 1e-3);
    before_m = offset_m;
  }
  EXPECT_NEAR(centring.offset_m(5.5), 0.05, 0.004);
  EXPECT_NEAR(centring.slope(5.5), 0.02, 0.005);
}

TEST(PassageCentring, LeavesTheSameRoomToTheFlankAndTheCornersInABend) {
  constexpr double kRadiusM = 20.0;
  std::vector<PathRun::Knot> knots;  // to the left, around (0, 20)
  for (double s = 0.0; s < 10.0; s += 0.1)
    knots.push_back({s,
                     {kRadiusM * std::sin(s / kRadiusM), kRadiusM * (1.0 - std::cos(s / kRadiusM)),
                      s / kRadiusM},
                     0.05});
  std::vector<Eigen::Vector2d> points;
  for (double angle = 0.0; angle < 0.4; angle += 0.0005) {
    for (const double radius_m : {kRadiusM - 0.65, kRadiusM + 0.65})
      points.emplace_back(radius_m * std::sin(angle), kRadiusM - radius_m * std::cos(angle));
  }
  PassageCentring centring(vehicle(), {});
  centring.add(points, PathRun(std::move(knots), false), 1.0);
  // The corners are L²/8R farther out than the middle of the body; half of it, to the inner side.
  EXPECT_NEAR(centring.offset_m(3.4), 2.4 * 2.4 / (16.0 * kRadiusM), 0.003);
}

TEST(PassageCentring, InterpolatesBesideTheBody) {
  PassageCentring centring(vehicle(), {});
  centring.add(walls(-0.62, 0.68, 5.9, 9.5), straight_run(), 5.0);  // front laser
  centring.add(walls(-0.65, 0.65, 1.0, 4.1), straight_run(), 5.0);  // rear laser
  EXPECT_NEAR(centring.offset_m(5.0), 0.015, 0.004);
}

TEST(PassageCentring, ForgetsWithANewRun) {
  PassageCentring centring(vehicle(), {});
  centring.add(walls(-0.62, 0.68, 0.9, 4.5), straight_run(), 0.0);
  centring.reset();
  EXPECT_EQ(centring.offset_m(0.0), 0.0);
}

}  // namespace
}  // namespace adit
