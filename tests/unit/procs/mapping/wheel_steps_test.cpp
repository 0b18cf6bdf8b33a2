// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/wheel_steps.hpp"

#include <cstdint>

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr std::int64_t kPeriodUs = 50'000;

/// Readings at 0.5 m/s along x, one per 0.05 s, up to `end_utime`.
void drive_to(WheelSteps& wheels, std::int64_t from_utime, std::int64_t end_utime) {
  for (std::int64_t t = from_utime; t <= end_utime; t += kPeriodUs)
    wheels.add({t, {0.5e-6 * static_cast<double>(t), 0.0, 0.0}});
}

TEST(WheelSteps, AddUpToTheMotionOfTheWheels) {
  WheelSteps wheels;
  double sum_m = 0.0;
  std::int64_t next_utime = kPeriodUs;
  for (std::int64_t t = kPeriodUs; t <= 2'000'000; t += 13'000) {
    for (; next_utime + 20'000 <= t; next_utime += kPeriodUs) {  // readings are late
      drive_to(wheels, next_utime, next_utime);
    }
    if (const auto step = wheels.step_to(t)) sum_m += step->x;
  }
  EXPECT_NEAR(sum_m, 0.5 * 1.9, 0.04);  // but for what was rolled before the first two readings
}

TEST(WheelSteps, HaveGapsWhereReadingsHave) {
  WheelSteps wheels;
  EXPECT_FALSE(wheels.step_to(100'000));
  drive_to(wheels, 0, 1'000'000);
  EXPECT_FALSE(wheels.step_to(500'000));  // no reading before the step
  EXPECT_NEAR(wheels.step_to(900'000)->x, 0.2, 1e-9);
  EXPECT_FALSE(wheels.step_to(3'000'000));
}

TEST(WheelSteps, RejectAResetOfTheOdometry) {
  WheelSteps wheels;
  drive_to(wheels, 4'000'000, 5'000'000);
  EXPECT_FALSE(wheels.step_to(5'000'000));
  wheels.add({5'050'000, {}});
  EXPECT_FALSE(wheels.step_to(5'050'000));
}

}  // namespace
}  // namespace adit
