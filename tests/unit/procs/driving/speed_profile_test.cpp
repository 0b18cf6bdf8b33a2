// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/driving/speed_profile.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "procs/driving/blended_run.hpp"
#include "tests/support/path_sketch.hpp"

namespace adit {
namespace {

constexpr double kRate = 0.4;

PathRun run_of(const PlannedPath& path) {
  return blended(runs_of(path.points, SteeredPoint({})).front(), 0.5);
}

TEST(SpeedProfile, NeverExceedsItsLimits) {
  const SpeedParams params;
  for (const PathShape& shape : path_shapes({}, 1.6)) {
    SCOPED_TRACE(shape.name);
    const PathRun run = run_of(shape.path);
    const SpeedProfile profile(run, params, 0.5, kRate);
    double last = profile.at(0.0);
    constexpr double kStepM = 0.01;
    for (double s_m = 0.1; s_m < run.length_m() - 0.1; s_m += kStepM) {
      const double v = profile.at(s_m);
      const double bend = run.curvature_1_m(s_m - 0.05, s_m + 0.05);
      const double change =
          (run.curvature_1_m(s_m, s_m + 0.1) - run.curvature_1_m(s_m - 0.1, s_m)) / 0.1;
      ASSERT_LE(v, params.speed_m_s);
      ASSERT_GE(v, params.creep_m_s);
      ASSERT_LE(v * v * std::abs(bend), 1.02 * params.lateral_acceleration_m_s2);  // samples
      ASSERT_LE(v * std::abs(change), kRate);
      if (s_m > 0.1) {
        ASSERT_LE((last * last - v * v) / (2.0 * kStepM), params.acceleration_m_s2 + 1e-9);
      }
      last = v;
    }
    EXPECT_EQ(profile.at(run.length_m()), 0.0);
    EXPECT_EQ(profile.at(run.length_m() + 1.0), 0.0);
  }
}

TEST(SpeedProfile, BrakesToTheEndAsATrapezoid) {
  const PathRun run = run_of(PathSketch({}).go(5.0).path());
  const SpeedProfile profile(run, {}, 0.5, kRate);
  EXPECT_DOUBLE_EQ(profile.at(1.0), 0.4);
  for (const double left_m : {0.35, 0.2, 0.1}) {
    EXPECT_NEAR(profile.at(5.0 - left_m), std::sqrt(2.0 * 0.2 * left_m), 1e-9);
  }
}

TEST(SpeedProfile, IsSlowBesideObstacles) {
  PlannedPath path = PathSketch({}).go(5.0).path();
  for (PathPoint& point : path.points) point.clearance_m = 0.15;
  EXPECT_NEAR(SpeedProfile(run_of(path), {}, 0.5, kRate).at(2.0), 0.2, 1e-9);
  for (PathPoint& point : path.points) point.clearance_m = 0.0;
  EXPECT_NEAR(SpeedProfile(run_of(path), {}, 0.5, kRate).at(2.0), 0.05, 1e-9);
}

TEST(SpeedProfile, KeepsToWhatTheVehicleCanDo) {
  const PathRun run = run_of(PathSketch({}).go(5.0).path());
  EXPECT_DOUBLE_EQ(SpeedProfile(run, {}, 0.3, kRate).at(2.0), 0.3);
  EXPECT_DOUBLE_EQ(SpeedProfile(run, {}, 0.03, kRate).at(2.0), 0.03);
}

}  // namespace
}  // namespace adit
