// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/c_space/heading_set.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>

#include "common/geometry/pose2.hpp"

namespace adit {
namespace {

class HeadingSetSizes : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Sizes, HeadingSetSizes, testing::Values(8, 16, 32, 64, 72));

TEST_P(HeadingSetSizes, HaveAboutEqualSpacing) {
  const HeadingSet headings(GetParam());
  const double gap = 2.0 * std::numbers::pi / GetParam();
  for (int k = 0; k < GetParam(); ++k) {
    EXPECT_NEAR(angle_diff(headings.angle(k), k * gap), 0.0, gap / 8.0) << k;
  }
}

TEST_P(HeadingSetSizes, AreSymmetricUnderReflectionAndRotation) {
  const HeadingSet headings(GetParam());
  for (int k = 0; k < GetParam(); ++k) {
    const Eigen::Vector2i& v = headings.direction(k);
    EXPECT_EQ(headings.direction(headings.wrapped(-k)), Eigen::Vector2i(v.x(), -v.y()));
    EXPECT_EQ(headings.direction(headings.wrapped(k + GetParam() / 4)),
              Eigen::Vector2i(-v.y(), v.x()));
  }
}

TEST_P(HeadingSetSizes, FindTheNearestHeading) {
  const HeadingSet headings(GetParam());
  for (double angle = -4.0; angle < 4.0; angle += 0.013) {
    const double error = std::abs(angle_diff(headings.angle(headings.nearest(angle)), angle));
    for (int k = 0; k < GetParam(); ++k) {
      EXPECT_LE(error, std::abs(angle_diff(headings.angle(k), angle)) + 1e-12);
    }
  }
}

TEST(HeadingSet, RejectsCountsWithoutSymmetry) {
  EXPECT_THROW(HeadingSet(0), std::invalid_argument);
  EXPECT_THROW(HeadingSet(12), std::invalid_argument);
  EXPECT_THROW(HeadingSet(1024), std::invalid_argument);
}

}  // namespace
}  // namespace adit
