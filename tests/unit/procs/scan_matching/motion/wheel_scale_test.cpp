// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/scan_matching/motion/wheel_scale.hpp"

#include <cmath>
#include <cstdint>
#include <random>

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr double kStepM = 0.1;
constexpr double kTrueScale = 0.985;

/// Drives along a ramp with wheels that measure too much, by a random walk as assumed.
void drive(WheelScale& scale, double metres, std::uint64_t seed, double direction = 1.0,
           double level_share = 1.0) {
  std::mt19937 random(seed);
  std::normal_distribution<double> walk(0.0, WheelScaleParams{}.m_per_sqrt_m * std::sqrt(kStepM));
  for (int i = 0; i < std::lround(metres / kStepM); ++i) {
    const double wheels_m = kStepM / level_share / kTrueScale + walk(random);
    scale.add({direction * wheels_m, 0.0, 0.0}, level_share, Pose2{direction * kStepM, 0.0, 0.0});
  }
}

TEST(WheelScale, IsOneUntilScansMeasureIt) {
  WheelScale scale{WheelScaleParams{}};
  for (int i = 0; i < 1000; ++i) scale.add({0.1, 0.0, 0.0}, 1.0, std::nullopt);
  EXPECT_EQ(scale.scale(), 1.0);
  EXPECT_GT(scale.sd(), WheelScaleParams{}.sd);  // other ground may have another scale
}

TEST(WheelScale, IsConsistentWithItsStandardDeviation) {
  // The mean of the normalised error squared is 1; of 200 seeds its standard deviation is 0.1. The
  // walk of the scale, which these wheels do not have, makes the filter less sure than it could be.
  double sum = 0.0;
  constexpr int kSeeds = 200;
  for (int seed = 0; seed < kSeeds; ++seed) {
    WheelScale scale{WheelScaleParams{}};
    drive(scale, 40.0, seed);
    sum += std::pow((scale.scale() - kTrueScale) / scale.sd(), 2);
    EXPECT_LT(scale.sd(), 0.4 * WheelScaleParams{}.sd);
  }
  EXPECT_LT(sum / kSeeds, 1.3);
  EXPECT_GT(sum / kSeeds, 0.4);
}

TEST(WheelScale, IsTheSameInReverseAndOnARamp) {
  for (const double direction : {1.0, -1.0}) {
    for (const double level_share : {1.0, std::cos(0.25)}) {
      WheelScale scale{WheelScaleParams{}};
      drive(scale, 200.0, 7, direction, level_share);
      EXPECT_NEAR(scale.scale(), kTrueScale, 3.0 * scale.sd());
      EXPECT_LT(std::abs(scale.scale() - kTrueScale), std::abs(1.0 - kTrueScale) / 2.0);
    }
  }
}

TEST(WheelScale, IgnoresWheelsThatSpin) {
  WheelScale scale{WheelScaleParams{}};
  drive(scale, 40.0, 3);
  const double before = scale.scale();
  for (int i = 0; i < 100; ++i) scale.add({0.1, 0.0, 0.0}, 1.0, Pose2{0.01, 0.0, 0.0});
  EXPECT_EQ(scale.scale(), before);
}

TEST(WheelScale, UsesNoStretchThatIsTooShort) {
  WheelScale scale{WheelScaleParams{}};
  for (int i = 0; i < 100; ++i) {
    for (int k = 0; k < 4; ++k) scale.add({0.1, 0.0, 0.0}, 1.0, Pose2{0.097, 0.0, 0.0});
    scale.add({0.1, 0.0, 0.0}, 1.0, std::nullopt);
  }
  EXPECT_EQ(scale.scale(), 1.0);
}

}  // namespace
}  // namespace adit
