// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/vehicle/battery.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr double kExact = 1e-9;
constexpr double kCapacityWh = 10000.0;
constexpr double kHourS = 3600.0;
constexpr double kIdleW = 200.0;
constexpr double kWeightN = 680.0 * 9.81;
constexpr double kEfficiency = 0.5;
constexpr double kRolling = 0.15;

/// Mean power drawn over an hour [W].
double drawn_w(double speed_m_s, double rise) {
  VehicleModelParams params;
  params.battery_wh = kCapacityWh;
  Battery battery({}, params);
  battery.draw(speed_m_s, rise, kHourS);
  return (1.0 - battery.share()) * kCapacityWh;
}

TEST(Battery, DrawsIdlePowerAtRest) {
  EXPECT_NEAR(drawn_w(0.0, 0.0), kIdleW, kExact);
  EXPECT_NEAR(drawn_w(0.0, 0.3), kIdleW, kExact);  // the brakes hold it
}

TEST(Battery, DrawsAgainstRollingResistanceOnLevelGround) {
  const double expected = kIdleW + kWeightN * kRolling * 0.4 / kEfficiency;
  EXPECT_NEAR(drawn_w(0.4, 0.0), expected, kExact);
  EXPECT_NEAR(drawn_w(-0.4, 0.0), expected, kExact);
}

TEST(Battery, DrawsPowerUphillInEitherDirection) {
  const double rise = std::sin(0.2);
  const double expected = kIdleW + kWeightN * (kRolling * std::cos(0.2) + rise) * 0.4 / kEfficiency;
  EXPECT_NEAR(drawn_w(0.4, rise), expected, kExact);
  EXPECT_NEAR(drawn_w(-0.4, -rise), expected, kExact);
}

TEST(Battery, RecuperatesNothingDownhill) {
  EXPECT_NEAR(drawn_w(0.4, -0.3), kIdleW, kExact);  // steeper than it rolls by itself
  const double rise = -0.05;
  const double left = kRolling * std::sqrt(1.0 - rise * rise) + rise;
  EXPECT_NEAR(drawn_w(0.4, rise), kIdleW + kWeightN * left * 0.4 / kEfficiency, kExact);
}

TEST(Battery, IsEmptyWhenItsEnergyIsDrawn) {
  VehicleModelParams params;
  params.battery_wh = kIdleW;
  Battery battery({}, params);
  battery.draw(0.0, 0.0, 0.75 * kHourS);
  EXPECT_NEAR(battery.share(), 0.25, kExact);
  EXPECT_FALSE(battery.empty());
  battery.draw(0.0, 0.0, kHourS);
  EXPECT_EQ(battery.share(), 0.0);
  EXPECT_TRUE(battery.empty());
}

}  // namespace
}  // namespace adit
