// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/driving/pure_pursuit.hpp"

#include <gtest/gtest.h>

#include "tests/support/path_sketch.hpp"

namespace adit {
namespace {

PathRun run_of(const PlannedPath& path) { return runs_of(path.points, SteeredPoint({})).front(); }

TEST(PurePursuitCurvature, IsThatOfTheCircleThatItIsOn) {
  for (const double curvature : {0.5, -0.3}) {
    const PathRun ahead = run_of(PathSketch({}, {}, 0.02).go(5.0, curvature).path());
    const PathRun back = run_of(PathSketch({}, {}, 0.02).back(5.0, curvature).path());
    for (const double s_m : {1.0, 3.0, 4.9}) {  // the last looks behind the end
      EXPECT_NEAR(pursuit_curvature(ahead, s_m, ahead.at(s_m), 0.4, {}), curvature, 1e-3);
      EXPECT_NEAR(pursuit_curvature(back, s_m, back.at(s_m), -0.4, {}), curvature, 1e-3);
    }
  }
}

TEST(PurePursuitCurvature, LeadsToAPlaceFartherAheadTheFasterItGoes) {
  const PathRun run = run_of(PathSketch({}).go(5.0).path());
  const PursuitParams params{2.0, 0.6, 1.2};
  const Pose2 beside{1.0, 0.1, 0.0};
  const auto expected = [](double ahead_m) { return -0.2 / (0.01 + ahead_m * ahead_m); };
  EXPECT_NEAR(pursuit_curvature(run, 1.0, beside, 0.1, params), expected(0.6), 1e-9);
  EXPECT_NEAR(pursuit_curvature(run, 1.0, beside, 0.4, params), expected(0.8), 1e-9);
  EXPECT_NEAR(pursuit_curvature(run, 1.0, beside, 2.0, params), expected(1.2), 1e-9);
}

}  // namespace
}  // namespace adit
