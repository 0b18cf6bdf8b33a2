// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/laser/echo.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr double kPulse = 0.5;
constexpr double kShare = 0.2;

std::optional<Echo> merge(std::vector<Echo> echoes) { return merge_echoes(echoes, kPulse, kShare); }

TEST(Echoes, WithoutAnyGiveNothing) { EXPECT_FALSE(merge({})); }

TEST(Echoes, WithinAPulseAreWeightedByPower) {
  const auto one = merge({{3.4, 1.0}, {3.0, 3.0}});
  ASSERT_TRUE(one);
  EXPECT_DOUBLE_EQ(one->range_m, 3.1);
  EXPECT_DOUBLE_EQ(one->power, 4.0);
}

TEST(Echoes, MergeWithinAPulseOfTheNearestOnly) {
  EXPECT_DOUBLE_EQ(merge({{3.0, 1.0}, {3.4, 1.0}, {3.8, 1.0}})->range_m, 3.2);
}

TEST(Echoes, BeyondAPulseAreIgnored) {
  EXPECT_DOUBLE_EQ(merge({{5.0, 2.0}, {3.0, 1.0}})->range_m, 3.0);
}

TEST(Echoes, AWeakNearerOneIsSkipped) {
  EXPECT_DOUBLE_EQ(merge({{5.0, 9.0}, {3.0, 1.0}})->range_m, 5.0);
}

TEST(Echoes, TheStrongestIsUsedIfAllAreWeak) {
  std::vector<Echo> echoes;
  for (int i = 1; i <= 9; ++i) echoes.push_back({static_cast<double>(i), i == 7 ? 1.1 : 1.0});
  EXPECT_DOUBLE_EQ(merge(echoes)->range_m, 7.0);
}

TEST(Reflectance, OfWaterIsHighAtGrazingAndLowAtSteepIncidence) {
  EXPECT_NEAR(specular_share(1.0), 0.02, 1e-3);
  EXPECT_NEAR(specular_share(0.0), 1.0, 1e-12);
  // Fresnel's equations for n = 1.33 at 60°; Schlick's form is this near to them.
  EXPECT_NEAR(specular_share(0.5), 0.059, 0.015);
}

}  // namespace
}  // namespace adit
