// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/surface/heights.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>

namespace adit {
namespace {

HeightsDescription smooth() {
  HeightsDescription description;
  description.floor_relief.height_m = 0.0;
  description.roof_relief.height_m = 0.0;
  return description;
}

TEST(HeightProfile, GoesThroughItsPointsAndIsLevelBeyondThem) {
  const HeightProfile profile({0.0, 1.0, 10.0, 3.0, 15.0, 2.0});
  EXPECT_DOUBLE_EQ(profile.at(-5.0), 1.0);
  EXPECT_DOUBLE_EQ(profile.at(0.0), 1.0);
  EXPECT_DOUBLE_EQ(profile.at(10.0), 3.0);
  EXPECT_DOUBLE_EQ(profile.at(15.0), 2.0);
  EXPECT_DOUBLE_EQ(profile.at(99.0), 2.0);
}

TEST(HeightProfile, IsSmoothAndMonotonic) {
  const HeightProfile profile({0.0, 0.0, 10.0, 1.0, 14.0, 4.0});
  constexpr double kStep = 0.01;
  double slope_before = 0.0;
  for (double s = -1.0; s < 15.0; s += kStep) {
    const double slope = (profile.at(s + kStep) - profile.at(s)) / kStep;
    EXPECT_GE(slope, -1e-12);
    EXPECT_NEAR(slope, slope_before, 0.02);  // 4 m in 14 m curve by less than 2 /m
    slope_before = slope;
  }
}

TEST(HeightProfile, RejectsDistancesThatDoNotAscend) {
  EXPECT_THROW(HeightProfile({0.0, 0.0, 0.0, 1.0}), std::invalid_argument);
  EXPECT_THROW(HeightProfile({0.0, 0.0, 5.0}), std::invalid_argument);
  EXPECT_THROW(HeightProfile({0.0, std::nan("")}), std::invalid_argument);
}

TEST(Heights, FollowTheProfileAlongItsHeading) {
  HeightsDescription description = smooth();
  description.profile_m = {0.0, 0.0, 10.0, 2.0};
  description.heading_rad = std::numbers::pi / 2.0;
  const Heights heights(description, 1);
  EXPECT_NEAR(heights.floor({7.0, 5.0}), 1.0, 1e-12);
  EXPECT_NEAR(heights.roof({7.0, 5.0}), 3.0, 1e-12);
  EXPECT_NEAR(heights.floor({7.0, 50.0}), 2.0, 1e-12);
}

TEST(Heights, KeepWithinTheirRelief) {
  HeightsDescription description = smooth();
  description.floor_relief = {.height_m = 0.1, .length_m = 1.0, .octaves = 4};
  const Heights heights(description, 1);
  double most = 0.0;
  for (int i = 0; i < 5000; ++i) {
    most = std::max(most, std::abs(heights.floor({0.31 * i, -0.17 * i})));
    EXPECT_EQ(heights.roof({0.31 * i, -0.17 * i}), 2.0);
  }
  EXPECT_LE(most, 0.1);
  EXPECT_GT(most, 0.05);
}

TEST(Heights, ChangeWithinARectangleOnly) {
  Heights heights(smooth(), 1);
  heights.change_floor({{0.0, 0.0}, {1.0, 1.0}, [](const Eigen::Vector2d& p, double height) {
                          return height - p.x();
                        }});
  EXPECT_DOUBLE_EQ(heights.floor({0.5, 0.5}), -0.5);
  EXPECT_DOUBLE_EQ(heights.floor({0.5, 1.5}), 0.0);
  EXPECT_DOUBLE_EQ(heights.roof({0.5, 0.5}), 2.0);
}

TEST(Heights, RoofStaysAboveTheFloor) {
  Heights heights(smooth(), 1);
  heights.change_floor(
      {{0.0, 0.0}, {1.0, 1.0}, [](const Eigen::Vector2d&, double) { return 5.0; }});
  EXPECT_DOUBLE_EQ(heights.roof({0.5, 0.5}), 5.05);
}

}  // namespace
}  // namespace adit
