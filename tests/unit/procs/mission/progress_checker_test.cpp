// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
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

}  // namespace
}  // namespace adit
