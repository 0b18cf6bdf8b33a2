// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/scan_assembly/held_clouds.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr std::int64_t kUtime = 1'600'000'000'000'000;
constexpr std::int64_t kLater = kUtime + 100 * HeldClouds::kOnItsWayUs;

/// Scans that were sent when they were taken, a microsecond apart.
HeldClouds held(int clouds) {
  HeldClouds held;
  for (int i = 0; i < clouds; ++i) {
    Cloud cloud;
    cloud.utime = kUtime + i;
    held.add(cloud, cloud.utime);
  }
  return held;
}

CloudRequest of_who_has(const std::vector<std::int64_t>& have_utime, std::int64_t after_utime = 0) {
  return {kLater, "volume_map", after_utime, have_utime};
}

TEST(HeldClouds, GiveTheNewestThatTheOtherLacks) {
  const HeldClouds clouds = held(4);
  const Cloud* const missed = clouds.missed(of_who_has({kUtime + 3, kUtime + 1}), kLater);
  ASSERT_NE(missed, nullptr);
  EXPECT_EQ(missed->utime, kUtime + 2);
  EXPECT_EQ(clouds.missed(of_who_has({}), kLater)->utime, kUtime + 3);
}

TEST(HeldClouds, GiveNothingToWhoHasAllThatItWants) {
  const HeldClouds clouds = held(2);
  EXPECT_EQ(clouds.missed(of_who_has({kUtime + 1, kUtime}), kLater), nullptr);
  EXPECT_EQ(clouds.missed(of_who_has({}, kUtime + 1), kLater), nullptr);
  EXPECT_NE(clouds.missed(of_who_has({}, kUtime), kLater), nullptr);
  EXPECT_EQ(HeldClouds{}.missed(of_who_has({}), kLater), nullptr);
}

TEST(HeldClouds, GiveNothingThatMayBeOnItsWay) {
  const HeldClouds clouds = held(1);
  const std::int64_t utime = kUtime + HeldClouds::kOnItsWayUs;
  EXPECT_EQ(clouds.missed(of_who_has({}), utime - 1), nullptr);
  EXPECT_NE(clouds.missed(of_who_has({}), utime), nullptr);
}

TEST(HeldClouds, AreTheNewest) {
  const HeldClouds clouds = held(static_cast<int>(HeldClouds::kMax) + 1);
  std::vector<std::int64_t> have;
  for (std::size_t i = 1; i <= HeldClouds::kMax; ++i) {
    have.push_back(kUtime + static_cast<std::int64_t>(i));
  }
  EXPECT_EQ(clouds.missed(of_who_has(have), kLater), nullptr);
}

}  // namespace
}  // namespace adit
