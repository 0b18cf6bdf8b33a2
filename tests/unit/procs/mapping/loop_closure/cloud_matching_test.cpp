// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/loop_closure/cloud_matching.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "tests/support/worlds/rock_sweep.hpp"

namespace adit {
namespace {

using test::pose;
using test::Rock;
using test::rough_tunnel;
using test::smooth_tunnel;
using test::sweep;

constexpr double kApartM = 4.0;

/// A 3D scan in each of two local maps along x, the second of which seems to be farther than it is.
struct TwoScans {
  CloudMatching matching;
  std::vector<PlacedLocalMap> placed{{{0.0, 0.0, 0.0}, 0.0}, {{kApartM + 0.15, 0.0, 0.0}, 0.0}};

  explicit TwoScans(const Rock& rock, const CloudMatchingParams& params = {}, int session = 0)
      : matching(params) {
    matching.add(sweep(rock, Eigen::Isometry3d::Identity(), 1), 0, {1, 0, 0.0, 0.0}, {});
    matching.add(sweep(rock, pose(kApartM, 0.0, 0.0, 0.0, 0.0, 0.0), 2), session, {2, 1, 0.0, 0.0},
                 {});
  }
  [[nodiscard]] std::vector<MatchedClouds> matches(int map = 1) const {
    return matching.matches(map, [&](int i) { return placed[static_cast<std::size_t>(i)]; });
  }
};

TEST(CloudMatching, FindsTheMotionAlongATunnelByItsBumps) {
  const auto matches = TwoScans(rough_tunnel).matches();
  ASSERT_EQ(matches.size(), 1U);
  EXPECT_EQ(matches[0].loop_closure.newer_map, 1);
  const LoopClosureAlternative& found = matches[0].loop_closure.alternatives.front();
  EXPECT_EQ(found.older_map, 0);
  EXPECT_NEAR(found.T_older_newer.x, kApartM, 0.03);
  const Eigen::Matrix3d covariance = found.information.inverse();
  EXPECT_LT(std::sqrt(covariance(0, 0)), 0.07);
  EXPECT_LT(std::abs(found.T_older_newer.x - kApartM), 3.0 * std::sqrt(covariance(0, 0)));
}

TEST(CloudMatching, LeavesASmoothTunnelToTheWheels) {
  for (const MatchedClouds& match : TwoScans(smooth_tunnel).matches()) {
    const auto& information = match.loop_closure.alternatives.front().information;
    EXPECT_GT(information.inverse()(0, 0), 1.0);
  }
}

/// Across the displacement planar scans are more accurate.
TEST(CloudMatching, IsNotSureAcrossAndOfTheTurn) {
  const auto matches = TwoScans(rough_tunnel).matches();
  ASSERT_EQ(matches.size(), 1U);
  const CloudMatchingParams params;
  const Eigen::Matrix3d covariance =
      matches[0].loop_closure.alternatives.front().information.inverse();
  EXPECT_GE(std::sqrt(covariance(1, 1)), params.across_sd_m);
  EXPECT_GE(std::sqrt(covariance(2, 2)), params.turn_sd_rad);
}

/// The scans are taken somewhere in their local maps, turned and higher than the origin.
TEST(CloudMatching, RelatesTheOriginsOfTheLocalMaps) {
  const Pose2 T_local_first{1.0, 0.4, 0.6};
  const Pose2 T_local_second{2.0, -0.3, -0.4};
  CloudMatching matching{CloudMatchingParams{}};
  matching.add(sweep(rough_tunnel, Eigen::Isometry3d::Identity(), 1), 0, {1, 0, 0.3, 0.0},
               T_local_first);
  matching.add(sweep(rough_tunnel, pose(kApartM, 0.0, 0.0, 0.0, 0.0, 0.0), 2), 0, {2, 1, 0.1, 0.0},
               T_local_second);
  const Pose2 T_first_second = T_local_first * Pose2{kApartM, 0.0, 0.0} * T_local_second.inverse();
  const Pose2 T_map_first{5.0, 6.0, 1.0};
  const std::vector<PlacedLocalMap> placed{{T_map_first, 2.0}, {T_map_first * T_first_second, 2.2}};
  const auto matches =
      matching.matches(1, [&](int i) { return placed[static_cast<std::size_t>(i)]; });
  ASSERT_EQ(matches.size(), 1U);
  const Pose2 error =
      between(T_first_second, matches[0].loop_closure.alternatives.front().T_older_newer);
  EXPECT_LT(error.translation().norm(), 0.04);
  EXPECT_LT(std::abs(error.theta), 0.01);
}

TEST(CloudMatching, ShowsTheTiltOfInclinedLevelFrames) {
  const Eigen::Vector2d e(0.01, 0.006);  // of both, about their own axes
  constexpr double kTurn = 0.4;
  CloudMatching matching{CloudMatchingParams{}};
  matching.add(sweep(rough_tunnel, pose(0.0, 0.0, 0.0, -e.x(), -e.y(), 0.0), 1), 0,
               {1, 0, 0.0, 0.0}, {});
  matching.add(
      sweep(rough_tunnel,
            pose(2.0, 0.0, 0.0, 0.0, 0.0, kTurn) * pose(0.0, 0.0, 0.0, -e.x(), -e.y(), 0.0), 2),
      0, {2, 1, 0.0, 0.0}, {});
  const std::vector<PlacedLocalMap> placed{{{0.0, 0.0, 0.0}, 0.0}, {{2.0, 0.0, kTurn}, 0.0}};
  const auto matches =
      matching.matches(1, [&](int i) { return placed[static_cast<std::size_t>(i)]; });
  ASSERT_EQ(matches.size(), 1U);
  const Eigen::Vector2d expected = -(e - Eigen::Rotation2Dd(-kTurn).toRotationMatrix() * e);
  EXPECT_LT((matches[0].match.tilt_rad - expected).norm(), 0.003);
  EXPECT_NEAR(matches[0].match.turn_rad, kTurn, 0.01);
}

/// By rubble on which the whole body stands higher, floor and roof seem to have sunk. The wheels
/// and the pitch do not show it, and the local maps are placed as if it were level.
TEST(CloudMatching, MeasuresTheRiseOfTheBody) {
  constexpr double kRise = 0.04;
  CloudMatching matching{CloudMatchingParams{}};
  matching.add(sweep(rough_tunnel, Eigen::Isometry3d::Identity(), 1), 0, {1, 0, 0.0, 0.0}, {});
  matching.add(sweep(rough_tunnel, pose(kApartM, 0.0, kRise, 0.0, 0.0, 0.0), 2), 0,
               {2, 1, 0.0, 0.0}, {});
  const std::vector<PlacedLocalMap> placed{{{0.0, 0.0, 0.0}, 0.0}, {{kApartM, 0.0, 0.0}, 0.0}};
  const auto matches =
      matching.matches(1, [&](int i) { return placed[static_cast<std::size_t>(i)]; });
  ASSERT_EQ(matches.size(), 1U);
  const CloudMatch& match = matches[0].match;
  EXPECT_NEAR(match.rise_m, kRise, 0.01);
  EXPECT_LT(match.rise_sd_m, 0.015);
  EXPECT_NEAR(match.lever_m.x(), kApartM, 0.05);
  EXPECT_EQ(match.older, (CloudPlace{1, 0, 0.0, 0.0}));
  EXPECT_EQ(match.newer, (CloudPlace{2, 1, 0.0, 0.0}));
}

TEST(CloudMatching, MatchesNeitherEarlierSessionsNorScansFarAway) {
  EXPECT_TRUE(TwoScans(rough_tunnel, {}, 1).matches().empty());
  CloudMatchingParams params;
  params.distance_max_m = kApartM - 1.0;
  EXPECT_TRUE(TwoScans(rough_tunnel, params).matches().empty());
}

/// Along the displacement of two scans, the newer one turned by this angle.
double sd_along_m(double turn_rad, double facing_variance_share) {
  CloudMatchingParams params;
  params.facing_variance_share = facing_variance_share;
  CloudMatching matching{params};
  const Pose2 T_older_newer{kApartM, 0.0, turn_rad};
  matching.add(sweep(rough_tunnel, Eigen::Isometry3d::Identity(), 1), 0, {1, 0, 0.0, 0.0}, {});
  matching.add(sweep(rough_tunnel, pose(kApartM, 0.0, 0.0, 0.0, 0.0, turn_rad), 2), 0,
               {2, 1, 0.0, 0.0}, {});
  const auto matches = matching.matches(1, [&](int map) {
    return PlacedLocalMap{map == 0 ? Pose2{} : T_older_newer, 0.0};
  });
  EXPECT_EQ(matches.size(), 1U);
  if (matches.empty()) return 0.0;
  const auto& information = matches[0].loop_closure.alternatives.front().information;
  const Eigen::Matrix2d R = Eigen::Rotation2Dd(turn_rad).toRotationMatrix();
  const Eigen::Matrix2d covariance =
      R * information.inverse().topLeftCorner<2, 2>() * R.transpose();
  return std::sqrt(covariance(0, 0));
}

/// They see other sides of the same bumps.
TEST(CloudMatching, IsUnsureOfTheDistanceOfScansThatLookAtEachOther) {
  const CloudMatchingParams params;
  for (const double turn_rad : {0.0, 1.2, 2.4, M_PI}) {
    const double as_others_m = sd_along_m(turn_rad, params.displacement_variance_share);
    const double sd_m = sd_along_m(turn_rad, params.facing_variance_share);
    EXPECT_EQ(sd_m > 2.0 * as_others_m, turn_rad > 2.0) << turn_rad;
  }
}

/// The wheels slipped by more than the basin of one alignment is wide, and the map says how far
/// they may have.
TEST(CloudMatching, FindsADisplacementThatTheWheelsMissedByFar) {
  for (const double off_m : {-0.9, -0.6, 0.6, 0.9}) {
    TwoScans scans(rough_tunnel);
    scans.placed[1].T_map_local.x = kApartM + off_m;
    const Eigen::Matrix3d covariance = Eigen::Vector3d(0.16, 1e-4, 1e-5).asDiagonal();
    const auto matches = scans.matching.matches(
        1, [&](int i) { return scans.placed[static_cast<std::size_t>(i)]; },
        [&](int) { return covariance; });
    ASSERT_EQ(matches.size(), 1U) << off_m;
    const LoopClosureAlternative& found = matches[0].loop_closure.alternatives.front();
    EXPECT_NEAR(found.T_older_newer.x, kApartM, 0.03) << off_m;
  }
}

/// Ribs at equal distances: no place is better than the next one.
TEST(CloudMatching, OffersEachPlaceWhereWallsThatRepeatFit) {
  constexpr double kPeriodM = 0.8;
  const Rock ribs = [](const Eigen::Vector3d& p) -> double {
    return 0.8 * (smooth_tunnel(p) + 0.05 * std::sin(2.0 * M_PI * p.x() / kPeriodM));
  };
  TwoScans scans(ribs);
  scans.placed[1].T_map_local.x = kApartM + 0.4 * kPeriodM;
  const Eigen::Matrix3d covariance = Eigen::Vector3d(0.25, 1e-4, 1e-5).asDiagonal();
  const auto matches = scans.matching.matches(
      1, [&](int i) { return scans.placed[static_cast<std::size_t>(i)]; },
      [&](int) { return covariance; });
  ASSERT_EQ(matches.size(), 1U);
  const std::vector<LoopClosureAlternative>& places = matches[0].loop_closure.alternatives;
  const auto has = [&](double x_m) {
    return std::ranges::any_of(places, [&](const LoopClosureAlternative& place) {
      return std::abs(place.T_older_newer.x - x_m) < 0.05;
    });
  };
  EXPECT_TRUE(has(kApartM));
  EXPECT_TRUE(has(kApartM + kPeriodM));
  for (const LoopClosureAlternative& place : places) {
    const double periods = (place.T_older_newer.x - kApartM) / kPeriodM;
    EXPECT_NEAR(periods, std::round(periods), 0.1);
  }
}

TEST(CloudMatching, StoresALimitedNumberOfScans) {
  CloudMatchingParams params;
  params.stored_max = 1;
  EXPECT_TRUE(TwoScans(rough_tunnel, params).matches().empty());
  params.stored_max = 0;
  EXPECT_TRUE(TwoScans(rough_tunnel, params).matches().empty());
}

TEST(CloudMatching, ADiscardedLocalMapTakesItsScansWithIt) {
  TwoScans scans(rough_tunnel);
  scans.matching.discard(0);  // the second local map has its id
  EXPECT_TRUE(scans.matches(0).empty());
  EXPECT_TRUE(scans.matches(1).empty());
}

}  // namespace
}  // namespace adit
