// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

#include "procs/mission/progress.hpp"

namespace adit {
namespace {

TEST(RejectedPlaces, AreNearARobotThatReturns) {
  RejectedPlaces rejected;
  EXPECT_TRUE(rejected.all_farther_than(1.0, {0.0, 0.0}));
  rejected.add({0.0, 0.0});
  EXPECT_FALSE(rejected.all_farther_than(1.0, {0.9, 0.0}));
  EXPECT_TRUE(rejected.all_farther_than(1.0, {1.1, 0.0}));
  rejected.add({10.0, 0.0});
  EXPECT_FALSE(rejected.all_farther_than(1.0, {0.5, 0.0}));
}

TEST(RejectedPlaces, StoreTheNewestOnly) {
  RejectedPlaces rejected;
  rejected.add({-5.0, 0.0});
  for (std::size_t i = 0; i < RejectedPlaces::kPlacesStoredMax; ++i) {
    rejected.add({static_cast<double>(i), 0.0});
  }
  EXPECT_TRUE(rejected.all_farther_than(1.0, {-5.0, 0.0}));
  EXPECT_FALSE(rejected.all_farther_than(1.0, {0.0, 0.0}));
}

/// A robot drives 10 m along x, is rejected, backs off and comes back less far.
TEST(ProgressChecker, EndingShortOfARejectedPlaceIsNoProgress) {
  TraversedPath path;
  std::int64_t utime = 0;
  const auto drive = [&](double to_m) {
    while (std::abs(path.T_odom_body()->x - to_m) > 0.05) {
      const double x_m = path.T_odom_body()->x;
      path.add(++utime, {x_m + (to_m > x_m ? 0.1 : -0.1), 0.0, 0.0});
    }
  };
  path.add(++utime, {});
  drive(10.0);
  ProgressChecker progress;
  progress.add_rejection(path.recent(8.0));
  drive(4.0);
  progress.begin_drive(path.distance_travelled_m());
  drive(7.5);
  EXPECT_FALSE(progress.is_beyond_rejections(path));
  drive(10.8);
  EXPECT_FALSE(progress.is_beyond_rejections(path));  // within a metre
  drive(11.2);
  EXPECT_TRUE(progress.is_beyond_rejections(path));
}

}  // namespace
}  // namespace adit
