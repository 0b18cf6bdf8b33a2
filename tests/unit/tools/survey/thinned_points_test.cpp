// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/points/thinned_points.hpp"

#include <utility>

#include <gtest/gtest.h>

namespace adit {
namespace {

/// A square of 10 m with points 1 cm apart, each with its number.
ThinnedPoints thinned_square(std::size_t points_max) {
  ThinnedPoints thinned(0.1, points_max);
  for (std::uint32_t i = 0; i < 1'000'000; ++i) {
    const auto x = static_cast<float>(i / 1000) + 0.5F;
    const auto y = static_cast<float>(i % 1000) + 0.5F;
    thinned.add({{0.01F * x, 0.01F * y, 0.005F}, i});
  }
  return thinned;
}

TEST(ThinnedPoints, AreTheFirstOfEachCube) {
  ThinnedPoints thinned = thinned_square(20'000);
  EXPECT_EQ(thinned.voxel_m(), 0.1);
  const auto points = std::move(thinned).release();
  ASSERT_EQ(points.size(), 10'000U);
  EXPECT_EQ(points[0].scan, 0U);
  EXPECT_EQ(points[1].scan, 10U);
}

TEST(ThinnedPoints, HaveLargerCubesWhereThereWouldBeTooMany) {
  ThinnedPoints thinned = thinned_square(5'000);
  EXPECT_EQ(thinned.voxel_m(), 0.2);
  const auto points = std::move(thinned).release();
  ASSERT_EQ(points.size(), 2'500U);
  EXPECT_EQ(points[1].scan, 20U);
}

}  // namespace
}  // namespace adit
