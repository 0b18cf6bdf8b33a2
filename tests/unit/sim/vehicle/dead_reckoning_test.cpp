// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "sim/vehicle/proprioception.hpp"

namespace adit {
namespace {

/// The reading after constant motion.
Pose2 reckoned(DeadReckoning reckoning, double speed_m_s, double curvature_1_m, double seconds,
               double step_s = 0.01) {
  const long steps = std::lround(seconds / step_s);
  for (long i = 0; i < steps; ++i) reckoning.advance(speed_m_s, curvature_1_m, step_s);
  return reckoning.reading(0).T_wheel_body;
}

WheelOdometryParams errors(double distance_scale, double turn_scale, double distance_noise,
                           double turn_noise) {
  return {true, distance_scale, turn_scale, 0.0, distance_noise, turn_noise};
}

TEST(DeadReckoning, ScalesDistanceAndTurn) {
  const WheelOdometryParams params = errors(1.01, 0.97, 0.0, 0.0);
  const Pose2 straight = reckoned(DeadReckoning(params, 1), 0.4, 0.0, 25.0);
  EXPECT_NEAR(straight.x, 10.1, 1e-9);
  EXPECT_NEAR(straight.y, 0.0, 1e-9);
  const Pose2 bend = reckoned(DeadReckoning(params, 1), -0.4, 0.1, 25.0);
  EXPECT_NEAR(bend.theta, -0.97, 1e-9);
  const double radius = 10.1 / 0.97;  // of an arc as long that turns as far
  EXPECT_NEAR(bend.x, -radius * std::sin(0.97), 1e-9);
  EXPECT_NEAR(bend.y, radius * (1.0 - std::cos(0.97)), 1e-9);
}

TEST(DeadReckoning, AccountsForTheSteering) {
  Vehicle vehicle;
  vehicle.steering = "ackermann";
  const double radius = 2.0;
  const double rear_radius =
      std::sqrt(radius * radius - 0.25 * vehicle.wheelbase_m * vehicle.wheelbase_m);
  const double seconds = 2.0 * std::numbers::pi * rear_radius / 0.4;  // a full circle
  const Pose2 end = reckoned(DeadReckoning(errors(1.0, 1.0, 0.0, 0.0), 1, vehicle), 0.4,
                             1.0 / radius, seconds, seconds / 1000.0);
  EXPECT_NEAR(end.x, 0.0, 1e-9);
  EXPECT_NEAR(end.y, 0.0, 1e-9);
}

TEST(DeadReckoning, DoesNotDriftAtRest) {
  EXPECT_EQ(reckoned(DeadReckoning({}, 3), 0.0, 0.3, 60.0), Pose2{});
}

/// Standard deviations over many drives of 25 m straight ahead.
struct Spread {
  double along_m;
  double turn_rad;
};
Spread spread(const WheelOdometryParams& params, double step_s) {
  constexpr int kDrives = 2000;
  double along = 0.0;
  double turn = 0.0;
  for (int seed = 0; seed < kDrives; ++seed) {
    const Pose2 end =
        reckoned(DeadReckoning(params, static_cast<std::uint64_t>(seed)), 0.5, 0.0, 50.0, step_s);
    along += (end.x - 25.0) * (end.x - 25.0);
    turn += end.theta * end.theta;
  }
  return {std::sqrt(along / kDrives), std::sqrt(turn / kDrives)};
}

TEST(DeadReckoning, ErrorGrowsWithTheRootOfTheDistanceForAnyStep) {
  for (const double step_s : {0.02, 0.5}) {
    // Over √25: five times. 2000 drives know a standard deviation to 1.6 %, three times.
    EXPECT_NEAR(spread(errors(1.0, 1.0, 0.01, 0.0), step_s).along_m, 0.05, 0.05 * 0.05);
    EXPECT_NEAR(spread(errors(1.0, 1.0, 0.0, 0.005), step_s).turn_rad, 0.025, 0.05 * 0.025);
  }
}

TEST(DeadReckoning, IsReproducible) {
  EXPECT_EQ(reckoned(DeadReckoning({}, 5), 0.4, 0.2, 10.0),
            reckoned(DeadReckoning({}, 5), 0.4, 0.2, 10.0));
}

}  // namespace
}  // namespace adit
