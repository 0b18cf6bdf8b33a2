// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include <gtest/gtest.h>

#include "sim/simulation/tilting_laser.hpp"

namespace adit {
namespace {

MotionHistory::BodyState state(std::int64_t utime, double x, double yaw, double tilt) {
  MotionHistory::BodyState made;
  made.utime = utime;
  made.T_world_body =
      Eigen::Translation3d(x, 0.0, 0.0) * Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ());
  made.tilt_rad = tilt;
  return made;
}

void expect_at(const MotionHistory& history, std::int64_t utime, double seconds,
               const MotionHistory::BodyState& right) {
  const auto found = history.at(utime, seconds);
  EXPECT_TRUE(found.T_world_body.isApprox(right.T_world_body, 1e-12)) << utime << " " << seconds;
  EXPECT_NEAR(found.tilt_rad, right.tilt_rad, 1e-12);
}

TEST(MotionHistory, InterpolatesLinearly) {
  MotionHistory history(state(1'000'000, 1.0, 0.0, 0.0));
  history.add(state(1'010'000, 2.0, 0.1, 0.2));
  history.add(state(1'020'000, 2.0, 0.3, 0.2));
  expect_at(history, 1'000'000, 0.0, state(0, 1.0, 0.0, 0.0));
  expect_at(history, 1'000'000, 0.0025, state(0, 1.25, 0.025, 0.05));
  expect_at(history, 1'004'000, 0.006, state(0, 2.0, 0.1, 0.2));
  expect_at(history, 1'004'000, 0.011, state(0, 2.0, 0.2, 0.2));
}

TEST(MotionHistory, ClampsToItsEnds) {
  MotionHistory history(state(1'000'000, 1.0, 0.0, 0.0));
  history.add(state(1'010'000, 2.0, 0.1, 0.2));
  expect_at(history, 900'000, 0.0, state(0, 1.0, 0.0, 0.0));
  expect_at(history, 1'010'000, 0.1, state(0, 2.0, 0.1, 0.2));
}

TEST(MotionHistory, KeepsTheStatesThatAreStillNeeded) {
  MotionHistory history(state(0, 0.0, 0.0, 0.0));
  for (double x = 1.0; x < 10.5; ++x) {
    history.add(state(std::llround(x * 10'000.0), x, 0.0, 0.0));
  }
  history.discard_before(55'000);
  expect_at(history, 55'000, 0.0, state(0, 5.5, 0.0, 0.0));
  expect_at(history, 10'000, 0.0, state(0, 5.0, 0.0, 0.0));
  history.discard_before(200'000);
  expect_at(history, 200'000, 0.0, state(0, 10.0, 0.0, 0.0));
}

}  // namespace
}  // namespace adit
