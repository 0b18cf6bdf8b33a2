// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/vehicle/kinematics.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

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

double mean_product(const std::vector<double>& values, double mean, std::size_t shift) {
  double sum = 0.0;
  for (std::size_t i = 0; i + shift < values.size(); ++i) {
    sum += (values[i] - mean) * (values[i + shift] - mean);
  }
  return sum / static_cast<double>(values.size() - shift);
}

TEST(WheelSlip, VariesAboutItsMeanOverAMetre) {
  VehicleModelParams params;
  params.slip_share = 0.3;  // so that nothing is clamped at 0
  params.slip_sd = 0.02;
  WheelSlip slip(params, 5);
  std::vector<double> lost;
  double sum = 0.0;
  constexpr int kPerMetre = 20;
  for (int i = 0; i < 20'000 * kPerMetre; ++i) {
    slip.advance(1.0 / kPerMetre);
    lost.push_back(slip.slip_ratio(0.0));
    sum += lost.back();
  }
  const double mean = sum / static_cast<double>(lost.size());
  // 20 km have 10 000 independent values: 1 % of a standard deviation, four times
  EXPECT_NEAR(mean, 0.3, 0.04 * 0.02);
  const double variance = mean_product(lost, mean, 0);
  EXPECT_NEAR(std::sqrt(variance), 0.02, 0.04 * 0.02);
  EXPECT_NEAR(mean_product(lost, mean, kPerMetre) / variance, std::exp(-1.0), 0.04);
}

TEST(WheelSlip, GrowsOnSoftGround) {
  VehicleModelParams params;
  params.slip_sd = 0.0;
  const WheelSlip slip(params, 1);
  EXPECT_DOUBLE_EQ(slip.slip_ratio(0.0), 0.03);
  EXPECT_GT(slip.slip_ratio(0.5), slip.slip_ratio(0.1));
  EXPECT_GT(std::abs(slip.side_slip_rad(1.0)), std::abs(slip.side_slip_rad(0.0)));
  EXPECT_LE(slip.slip_ratio(5.0), 0.9);
}

TEST(WheelSlip, IsZeroWithZeroParameters) {
  VehicleModelParams params;
  params.slip_share = params.slip_sd = params.side_slip_sd_rad = 0.0;
  WheelSlip slip(params, 1);
  slip.advance(1.0);
  EXPECT_EQ(slip.slip_ratio(0.0), 0.0);
  EXPECT_EQ(slip.side_slip_rad(0.0), 0.0);
}

}  // namespace
}  // namespace adit
