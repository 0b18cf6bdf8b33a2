// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/driving/path_progress.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/support/path_sketch.hpp"

namespace adit {
namespace {

PathProgress along(const PlannedPath& path) {
  return PathProgress(runs_of(path.points, SteeredPoint({})));
}

TEST(PathProgress, DoesNotJumpWhereThePathCrossesItself) {
  const double round_m = 2.0 * std::numbers::pi * 2.0;
  const auto eight = PathSketch({}).go(round_m, 0.5).go(round_m, -0.5).path();
  const PathRun run = runs_of(eight.points, SteeredPoint({})).front();
  PathProgress progress = along(eight);
  for (double s_m = 0.0; s_m < run.length_m(); s_m += 0.02) {
    const double aside = 0.1 * std::sin(s_m);
    progress.advance(run.at(s_m) * Pose2{0.0, aside, 0.0});
    ASSERT_NEAR(progress.s_m(), s_m, 0.02);  // corners between chords, 10 cm beside
    ASSERT_NEAR(progress.error(run.at(s_m) * Pose2{0.0, aside, 0.0}).lateral_m, aside, 0.002);
  }
}

TEST(PathProgress, NeverGoesBack) {
  PathProgress progress = along(PathSketch({}).go(5.0).path());
  progress.advance({0.4, 0.0, 0.0});
  progress.advance({0.8, 0.0, 0.0});
  progress.advance({0.5, 0.0, 0.0});
  EXPECT_NEAR(progress.s_m(), 0.8, 1e-9);
  EXPECT_NEAR(progress.remaining_m(), 4.2, 1e-9);
}

TEST(PathProgress, DrivesRunsInOrderAndCountsTheirWay) {
  PathProgress progress = along(PathSketch({}).go(1.0).back(2.0).path());
  for (const double x : {0.4, 0.8, 1.0}) progress.advance({x, 0.0, 0.0});
  EXPECT_NEAR(progress.run_remaining_m(), 0.0, 1e-9);
  EXPECT_NEAR(progress.remaining_m(), 2.0, 1e-9);
  ASSERT_TRUE(progress.begin_next_run());
  progress.advance({0.7, 0.1, 0.2});
  EXPECT_NEAR(progress.done_m(), 1.3, 1e-9);
  EXPECT_NEAR(progress.error({0.7, 0.1, 0.2}).lateral_m, 0.1, 1e-9);
  EXPECT_NEAR(progress.error({0.7, 0.1, 0.2}).heading_rad, 0.2, 1e-9);
  EXPECT_FALSE(progress.begin_next_run());
}

}  // namespace
}  // namespace adit
