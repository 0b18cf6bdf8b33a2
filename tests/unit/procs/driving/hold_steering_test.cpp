// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/driving/hold_steering.hpp"

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr std::int64_t kSecondUs = 1'000'000;

TEST(HoldSteering, SteersWithoutAHold) {
  HoldSteering steering;
  EXPECT_EQ(steering.share(), 1.0);
  steering.update(0, 2.0, false);
  EXPECT_EQ(steering.share(), 1.0);
}

TEST(HoldSteering, GoesStraightOnAndReturnsGradually) {
  HoldSteering steering;
  steering.update(0, 2.0, true);
  EXPECT_EQ(steering.share(), 0.0);
  steering.update(kSecondUs, 2.0, false);
  EXPECT_EQ(steering.share(), 0.0);
  steering.update(2 * kSecondUs, 2.15, false);
  EXPECT_NEAR(steering.share(), 0.5, 1e-9);
  steering.update(3 * kSecondUs, 2.4, false);
  EXPECT_EQ(steering.share(), 1.0);
}

TEST(HoldSteering, SteersAgainWhereStraightOnIsHeldToo) {
  HoldSteering steering;
  for (int s = 0; s <= 5; ++s) steering.update(s * kSecondUs, 2.0, true);
  EXPECT_EQ(steering.share(), 0.0);
  steering.update(6 * kSecondUs, 2.0, true);
  EXPECT_EQ(steering.share(), 1.0);
}

TEST(HoldSteering, ForgetsWithANewPath) {
  HoldSteering steering;
  steering.update(0, 2.0, true);
  steering.reset();
  EXPECT_EQ(steering.share(), 1.0);
}

}  // namespace
}  // namespace adit
