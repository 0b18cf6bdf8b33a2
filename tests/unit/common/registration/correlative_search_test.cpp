// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/registration/correlative_search.hpp"

#include <gtest/gtest.h>

#include "tests/support/worlds/wall_world.hpp"

namespace adit {
namespace {

const Pose2 kReferencePose{-2.0, 0.0, 0.2};

SurfelMap reference_of(const test::WallWorld& world, const Pose2& pose) {
  SurfelMap map{SurfelMapParams{}};
  map.insert(test::scan_points(world, pose), pose, 0.0);
  return map;
}

class CorrelativeSearchFinds : public testing::TestWithParam<Pose2> {};

TEST_P(CorrelativeSearchFinds, ALargeMotionToWithinItsStep) {
  const test::WallWorld room = test::crooked_room();
  const Pose2 truth = kReferencePose * GetParam();
  const CorrelativeSearchParams params;
  const auto peaks =
      search_correlation(test::scan_points(room, truth), reference_of(room, kReferencePose),
                         kReferencePose, {1.5, 1.2}, 3, params);
  ASSERT_FALSE(peaks.empty());
  const Pose2 error = between(truth, peaks.front().T_odom_body);
  EXPECT_LT(error.translation().norm(), 1.5 * params.cell_m);
  EXPECT_LT(std::abs(error.theta), 2.0 * params.angle_step_rad);
}

INSTANTIATE_TEST_SUITE_P(Motions, CorrelativeSearchFinds,
                         testing::Values(Pose2{}, Pose2{1.2, 0.0, 0.0}, Pose2{0.3, -0.9, 0.5},
                                         Pose2{-0.5, 0.4, -1.0}, Pose2{0.0, 0.0, 1.1}));

TEST(CorrelativeSearch, ReturnsDistinctPeaksInOrderOfScore) {
  const test::WallWorld room = test::crooked_room();
  const CorrelativeSearchParams params;
  const auto peaks =
      search_correlation(test::scan_points(room, kReferencePose),
                         reference_of(room, kReferencePose), kReferencePose, {1.0, 0.6}, 4, params);
  ASSERT_EQ(peaks.size(), 4U);
  for (std::size_t i = 1; i < peaks.size(); ++i) {
    EXPECT_LE(peaks[i].score, peaks[i - 1].score);
    EXPECT_NE(peaks[i].T_odom_body, peaks[i - 1].T_odom_body);
  }
  EXPECT_LE(peaks.front().score, 1.0);
}

TEST(CorrelativeSearch, BoundsNeverPruneTheBestPose) {
  // Branch and bound must not change the result: a search over small windows, each of which is one
  // block, finds no better score anywhere in the large window.
  const test::WallWorld mine = test::sample_mine(3);
  const Pose2 here{10.0, 0.0, 0.0};
  const SurfelMap reference = reference_of(mine, here);
  const auto points = test::scan_points(mine, here * Pose2{0.7, 0.3, 0.2});
  const CorrelativeSearchParams params;
  const auto all_peaks = search_correlation(points, reference, here, {1.2, 0.3}, 1, params);
  ASSERT_FALSE(all_peaks.empty());
  for (double x = -1.2; x <= 1.2; x += 0.4) {
    for (double y = -1.2; y <= 1.2; y += 0.4) {
      const Pose2 centre{here.x + x, here.y + y, here.theta};
      for (const auto& peak :
           search_correlation(points, reference, centre, {0.1, 0.3}, 1, params)) {
        const Eigen::Vector2d off = peak.T_odom_body.translation() - here.translation();
        if (off.cwiseAbs().maxCoeff() > 1.2) continue;          // outside of the large window
        EXPECT_LE(peak.score, all_peaks.front().score + 0.03);  // grids are aligned differently
      }
    }
  }
}

TEST(CorrelativeSearch, FindsThePoseInAWideWindow) {
  const test::WallWorld mine = test::sample_mine(3);
  const Pose2 here{10.0, 0.0, 0.0};
  CorrelativeSearchParams params;
  params.cell_m = 0.2;
  params.angle_step_rad = 0.035;
  const Pose2 centre = here * Pose2{7.0, -5.0, 2.0};
  const auto peaks = search_correlation(test::scan_points(mine, here), reference_of(mine, here),
                                        centre, {12.0, 3.1}, 1, params);
  ASSERT_FALSE(peaks.empty());
  const Pose2 error = between(here, peaks.front().T_odom_body);
  EXPECT_LT(error.translation().norm(), 1.5 * params.cell_m);
  EXPECT_LT(std::abs(error.theta), 2.0 * params.angle_step_rad);
}

TEST(CorrelativeSearch, FindsTheSameWithMoreLevels) {
  // A wide window has five levels, a narrow one three. Centres are all_peaks cells apart, so the
  // grids are aligned.
  const test::WallWorld mine = test::sample_mine(3);
  const Pose2 here{10.0, 0.0, 0.0};
  const SurfelMap reference = reference_of(mine, here);
  const auto points = test::scan_points(mine, here * Pose2{0.31, 0.22, 0.1});
  const CorrelativeSearchParams params;
  const Pose2 centre{here.x + 100.0 * params.cell_m, here.y - 30.0 * params.cell_m, here.theta};
  const auto narrow = search_correlation(points, reference, here, {1.0, 0.3}, 1, params);
  const auto wide = search_correlation(points, reference, centre, {12.0, 0.3}, 1, params);
  ASSERT_FALSE(narrow.empty());
  ASSERT_FALSE(wide.empty());
  EXPECT_NEAR(wide.front().score, narrow.front().score, 0.005);  // a point at the edge of a cell
  EXPECT_LT(between(narrow.front().T_odom_body, wide.front().T_odom_body).vector().norm(), 1e-6);
}

TEST(CorrelativeSearch, ReturnsAPeakOnceInAWindowOfAFullTurn) {
  const test::WallWorld room = test::crooked_room();
  const SurfelMap reference = reference_of(room, kReferencePose);
  const CorrelativeSearchParams params;
  const Pose2 turned_away{kReferencePose.x, kReferencePose.y, kReferencePose.theta + 3.1};
  const auto peaks = search_correlation(test::scan_points(room, kReferencePose), reference,
                                        turned_away, {0.5, 3.1416}, 10, params);
  ASSERT_EQ(peaks.size(), 10U);
  for (std::size_t i = 0; i < peaks.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const Pose2 apart = between(peaks[k].T_odom_body, peaks[i].T_odom_body);
      EXPECT_TRUE(apart.translation().norm() > params.peak_separation_cells * params.cell_m ||
                  std::abs(apart.theta) > params.peak_separation_cells * params.angle_step_rad)
          << i << " and " << k;
    }
  }
}

TEST(CorrelativeSearch, StaysInsideTheGate) {
  // Long along the body's x axis, narrow across.
  const test::WallWorld room = test::crooked_room();
  const SurfelMap reference = reference_of(room, kReferencePose);
  SearchWindow window{2.0, 0.3};
  window.information.diagonal() << 1.0, 100.0, 100.0;
  window.sigmas = 2.0;
  for (const double heading : {0.2, 1.3}) {
    const Pose2 centre{kReferencePose.x, kReferencePose.y, heading};
    for (const auto& peak : search_correlation(test::scan_points(room, kReferencePose), reference,
                                               centre, window, 20, {})) {
      const Pose2 off = between(centre, peak.T_odom_body);
      const double theta = angle_diff(peak.T_odom_body.theta, heading);
      EXPECT_LE(off.x * off.x + 100.0 * off.y * off.y + 100.0 * theta * theta, 4.0 + 1e-9);
    }
  }
}

TEST(CorrelativeSearch, DiscardsPeaksBelowTheMinimumScore) {
  const test::WallWorld room = test::crooked_room();
  const SurfelMap reference = reference_of(room, kReferencePose);
  CorrelativeSearchParams params;
  params.score_min = 0.5;
  const auto peaks = search_correlation(test::scan_points(room, kReferencePose), reference,
                                        kReferencePose, {1.0, 0.6}, 50, params);
  ASSERT_FALSE(peaks.empty());
  EXPECT_LT(peaks.size(), 50U);
  for (const auto& peak : peaks) EXPECT_GE(peak.score, params.score_min);
}

TEST(CorrelativeSearch, ReturnsNothingForAnEmptyScanOrReference) {
  const test::WallWorld room = test::crooked_room();
  const SurfelMap nothing{SurfelMapParams{}};
  EXPECT_TRUE(
      search_correlation(test::scan_points(room, {}), nothing, {}, {1.0, 0.5}, 3, {}).empty());
  EXPECT_TRUE(search_correlation({}, reference_of(room, {}), {}, {1.0, 0.5}, 3, {}).empty());
}

}  // namespace
}  // namespace adit
