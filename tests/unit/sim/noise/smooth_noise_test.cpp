// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/noise/smooth_noise.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace adit {
namespace {

Eigen::Vector3d place(int i) { return {0.37 * i - 90.0, 40.0 - 0.23 * i, 0.11 * i}; }

TEST(SmoothNoise, CoversTheRangeFromMinusOneToOne) {
  const SmoothNoise noise(1);
  double low = 0.0;
  double high = 0.0;
  for (int i = 0; i < 5000; ++i) {
    low = std::min(low, noise.in_space(place(i)));
    high = std::max(high, noise.in_space(place(i)));
  }
  EXPECT_GE(low, -1.0);
  EXPECT_LE(high, 1.0);
  EXPECT_LT(low, -0.6);
  EXPECT_GT(high, 0.6);
}

TEST(SmoothNoise, IsContinuous) {
  const SmoothNoise noise(2);
  constexpr double kStep = 1e-6;
  // Between values 2 apart along each axis the slope of the blend is 1.5 times that at most.
  constexpr double kSlope = 3.0 * 1.8;
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d p = place(i);
    const Eigen::Vector3d q = p + Eigen::Vector3d::Constant(kStep);
    EXPECT_NEAR(noise.in_space(p), noise.in_space(q), 2.0 * kSlope * kStep);
    EXPECT_NEAR(noise(p.head<2>()), noise(q.head<2>()), 2.0 * kSlope * kStep);
  }
}

TEST(SmoothNoise, DependsOnItsSeed) {
  int same = 0;
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(SmoothNoise(3).in_space(place(i)), SmoothNoise(3).in_space(place(i)));
    same += SmoothNoise(3).in_space(place(i)) == SmoothNoise(4).in_space(place(i)) ? 1 : 0;
  }
  EXPECT_EQ(same, 0);
}

TEST(SmoothNoise, VariesWithHeight) {
  const SmoothNoise noise(5);
  double change = 0.0;
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d p = place(i);
    change += std::abs(noise.in_space(p) - noise.in_space(p + Eigen::Vector3d::UnitZ()));
  }
  // The mean of |a − b| is 2/3 for two uniform values; blending makes it less.
  EXPECT_GT(change / 100.0, 0.2);
}

}  // namespace
}  // namespace adit
