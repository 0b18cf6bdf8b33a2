// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include <gtest/gtest.h>

#include "sim/vehicle/proprioception.hpp"

namespace adit {
namespace {

constexpr double kStepS = 0.01;
constexpr double kG = 9.81;

ImuParams perfect() {
  ImuParams params;
  params.gyro_noise_rad_s = params.gyro_bias_sd_rad_s = 0.0;
  params.gyro_bias_walk_rad_s_per_sqrt_s = 0.0;
  params.accelerometer_noise_m_s2 = params.accelerometer_bias_sd_m_s2 = 0.0;
  return params;
}

BodyMotion at_rest(const Eigen::Matrix3d& R_world_body = Eigen::Matrix3d::Identity()) {
  BodyMotion motion;
  motion.T_world_body.linear() = R_world_body;
  return motion;
}

/// Standard deviation about 0 of all axes of what `sample(i)` returns, for i below `count`.
template <class Sample>
double spread(int count, const Sample& sample) {
  double squares = 0.0;
  for (int i = 0; i < count; ++i) squares += sample(i).squaredNorm();
  return std::sqrt(squares / (3.0 * count));
}

TEST(InertialUnit, MeasuresGravityOnASlope) {
  InertialUnit unit(perfect(), 1);
  const double pitch = -0.2;  // nose up
  const double roll = 0.1;    // left side up
  const Eigen::Matrix3d R = (Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
                             Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()))
                                .toRotationMatrix();
  const ImuReading reading = unit.measure(at_rest(R), at_rest(R), kStepS);
  const Eigen::Vector3d expected(kG * std::sin(0.2), kG * std::cos(0.2) * std::sin(roll),
                                 kG * std::cos(0.2) * std::cos(roll));
  EXPECT_LT((reading.linear_acceleration - expected).norm(), 1e-12);
  EXPECT_EQ(reading.angular_velocity.norm(), 0.0);
}

TEST(InertialUnit, MeasuresTheMeanTurnInTheBodyFrame) {
  InertialUnit unit(perfect(), 1);
  const Eigen::Vector3d omega(0.1, -0.2, 0.3);
  BodyMotion before = at_rest(
      Eigen::AngleAxisd(1.0, Eigen::Vector3d(1.0, 2.0, 3.0).normalized()).toRotationMatrix());
  BodyMotion now = before;
  now.T_world_body.rotate(Eigen::AngleAxisd(omega.norm() * 0.05, omega.normalized()));
  now.utime = 77;
  const ImuReading reading = unit.measure(before, now, 0.05);
  EXPECT_LT((reading.angular_velocity - omega).norm(), 1e-9);
  EXPECT_EQ(reading.utime, 77);
}

TEST(InertialUnit, MeasuresAccelerationAndBends) {
  InertialUnit unit(perfect(), 1);
  BodyMotion before = at_rest();
  before.v_body.x() = 0.4;
  BodyMotion now = before;
  now.v_body.x() = 0.403;
  EXPECT_NEAR(unit.measure(before, now, kStepS).linear_acceleration.x(), 0.3, 1e-9);

  const double turn_rate = 0.25;  // v²κ = vω to the left
  now = before;
  now.T_world_body.rotate(Eigen::AngleAxisd(turn_rate * kStepS, Eigen::Vector3d::UnitZ()));
  // the mean over 10 ms differs by half of the turn meanwhile
  EXPECT_NEAR(unit.measure(before, now, kStepS).linear_acceleration.y(), 0.4 * turn_rate, 1e-5);
}

TEST(InertialUnit, NoiseIsThatOfTheParameters) {
  ImuParams params = perfect();
  params.gyro_noise_rad_s = 0.003;
  params.accelerometer_noise_m_s2 = 0.03;
  InertialUnit unit(params, 2);
  const auto gyro = [&](int) {
    return unit.measure(at_rest(), at_rest(), kStepS).angular_velocity;
  };
  const auto accelerometer = [&](int) -> Eigen::Vector3d {
    return unit.measure(at_rest(), at_rest(), kStepS).linear_acceleration -
           kG * Eigen::Vector3d::UnitZ();
  };
  // 60 000 values know a standard deviation to 0.3 %, three times
  EXPECT_NEAR(spread(20'000, gyro), 0.003, 0.01 * 0.003);
  EXPECT_NEAR(spread(20'000, accelerometer), 0.03, 0.01 * 0.03);
}

TEST(InertialUnit, EachUnitHasItsOwnBias) {
  ImuParams params = perfect();
  params.gyro_bias_sd_rad_s = 0.0005;
  params.accelerometer_bias_sd_m_s2 = 0.02;
  const auto gyro = [&](int seed) {
    InertialUnit unit(params, static_cast<std::uint64_t>(seed));
    Eigen::Vector3d first = unit.measure(at_rest(), at_rest(), kStepS).angular_velocity;
    EXPECT_EQ(first, unit.measure(at_rest(), at_rest(), kStepS).angular_velocity);
    return first;
  };
  const auto accelerometer = [&](int seed) -> Eigen::Vector3d {
    InertialUnit unit(params, static_cast<std::uint64_t>(seed));
    return unit.measure(at_rest(), at_rest(), kStepS).linear_acceleration -
           kG * Eigen::Vector3d::UnitZ();
  };
  // 6 000 values know a standard deviation to 0.9 %, three times
  EXPECT_NEAR(spread(2000, gyro), 0.0005, 0.027 * 0.0005);
  EXPECT_NEAR(spread(2000, accelerometer), 0.02, 0.027 * 0.02);
}

TEST(InertialUnit, TheBiasWalksWithTheRootOfTime) {
  ImuParams params = perfect();
  params.gyro_bias_walk_rad_s_per_sqrt_s = 0.00002;
  for (const double step_s : {0.1, 1.0}) {
    const auto after_100_s = [&](int seed) {
      InertialUnit unit(params, static_cast<std::uint64_t>(seed));
      ImuReading reading;
      for (int i = 0; i < std::lround(100.0 / step_s); ++i) {
        reading = unit.measure(at_rest(), at_rest(), step_s);
      }
      return reading.angular_velocity;
    };
    // 1500 values know a standard deviation to 1.8 %, three times
    EXPECT_NEAR(spread(500, after_100_s), 0.0002, 0.055 * 0.0002);
  }
}

}  // namespace
}  // namespace adit
