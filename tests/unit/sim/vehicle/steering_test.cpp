// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/vehicle/steering.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr double kExact = 1e-12;
constexpr double kQuarter = std::numbers::pi / 2.0;

Vehicle with_steering(const char* steering) {
  Vehicle vehicle;
  vehicle.steering = steering;
  return vehicle;
}

void expect_near(const Pose2& a, const Pose2& b) {
  EXPECT_NEAR(a.x, b.x, kExact);
  EXPECT_NEAR(a.y, b.y, kExact);
  EXPECT_NEAR(angle_diff(a.theta, b.theta), 0.0, kExact);
}

TEST(Steering, ArcsAreThoseOfACircle) {
  expect_near(along_arc(3.0 * kQuarter, kQuarter), {3.0, 3.0, kQuarter});
  expect_near(along_arc(-3.0 * kQuarter, -kQuarter), {-3.0, 3.0, -kQuarter});
  expect_near(along_arc(2.0, 0.0), {2.0, 0.0, 0.0});
}

TEST(Steering, ArcsAreContinuousNearStraight) {
  for (const double turn : {1.9e-4, 2.1e-4}) {  // to either side of where the series takes over
    expect_near(along_arc(1.0, turn), {std::sin(turn) / turn, (1.0 - std::cos(turn)) / turn, turn});
  }
}

TEST(Steering, WithFourWheelsTheOriginMovesAlongItsXAxis) {
  const Steering steering(with_steering("four_wheel"));
  EXPECT_DOUBLE_EQ(steering.turn_rad_per_m(0.5), 0.5);
  expect_near(steering.motion(2.0 * kQuarter, kQuarter), {2.0, 2.0, kQuarter});
}

TEST(Steering, WithAckermannTheRearAxleMovesAlongItsXAxis) {
  const Vehicle vehicle = with_steering("ackermann");
  const Steering steering(vehicle);
  const double half = 0.5 * vehicle.wheelbase_m;
  const double origin_radius = 2.0;
  const double rear_radius = std::sqrt(origin_radius * origin_radius - half * half);
  EXPECT_NEAR(steering.turn_rad_per_m(1.0 / origin_radius), 1.0 / rear_radius, kExact);
  // The centre of both circles lies beside the rear axle: a quarter turn about it.
  const Pose2 T_body_centre{-half, rear_radius, 0.0};
  const Pose2 quarter{0.0, 0.0, kQuarter};
  expect_near(steering.motion(rear_radius * kQuarter, kQuarter),
              T_body_centre * quarter * T_body_centre.inverse());
}

TEST(Steering, SideSlipTurnsThePathAndNotTheBody) {
  const Steering steering(with_steering("four_wheel"));
  expect_near(steering.motion(1.0, 0.0, 0.1), {std::cos(0.1), std::sin(0.1), 0.0});
}

TEST(Steering, RejectsATurningRadiusThatAckermannCannotDrive) {
  Vehicle vehicle = with_steering("ackermann");
  vehicle.turning_radius_m = 0.5 * vehicle.wheelbase_m;
  EXPECT_THROW(Steering{vehicle}, std::invalid_argument);
}

}  // namespace
}  // namespace adit
