// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/driving/hold_limit.hpp"

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr std::int64_t kStart = 1'600'000'000'000'000;
constexpr std::int64_t kSecond = 1'000'000;

TEST(HoldLimit, IsReachedBySomeoneHeldForLong) {
  HoldLimit limit(10.0);
  for (int s = 0; s <= 10; ++s) {
    limit.go_on(kStart + s * kSecond, 2.0, true);
    EXPECT_FALSE(limit.is_reached());
  }
  limit.go_on(kStart + 11 * kSecond, 2.0, true);
  EXPECT_TRUE(limit.is_reached());
}

TEST(HoldLimit, CountsStepsOfACentimetreAsStanding) {
  HoldLimit limit(10.0);
  for (int s = 0; s <= 10; ++s) limit.go_on(kStart + s * kSecond, 2.0 + 0.004 * s, s % 2 == 0);
  limit.go_on(kStart + 11 * kSecond, 2.04, false);
  EXPECT_FALSE(limit.is_reached());
  limit.go_on(kStart + 12 * kSecond, 2.04, true);
  EXPECT_TRUE(limit.is_reached());
}

TEST(HoldLimit, BeginsAnewAfterSomeWay) {
  HoldLimit limit(10.0);
  for (int s = 0; s <= 60; ++s) {
    limit.go_on(kStart + s * kSecond, 0.01 * s, true);
    EXPECT_FALSE(limit.is_reached());
  }
}

TEST(HoldLimit, IsNotReachedBySomeoneWhoStandsUnheld) {
  HoldLimit limit(10.0);
  for (int s = 0; s <= 60; ++s) limit.go_on(kStart + s * kSecond, 2.0, false);
  limit.go_on(kStart + 61 * kSecond, 2.0, true);
  EXPECT_FALSE(limit.is_reached());
}

}  // namespace
}  // namespace adit
