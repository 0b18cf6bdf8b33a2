// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/map_resender.hpp"

#include <set>
#include <vector>

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr std::size_t kMaps = 10;

std::vector<std::size_t> rest_of_round(MapResender& repeater) {
  std::vector<std::size_t> round;
  while (const auto next = repeater.next(kMaps)) round.push_back(*next);
  return round;
}

TEST(MapResender, SendsEachLocalMapOnce) {
  MapResender repeater;
  EXPECT_FALSE(repeater.next(kMaps));
  repeater.request(kMaps);
  EXPECT_EQ(rest_of_round(repeater), (std::vector<std::size_t>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}));
  EXPECT_TRUE(repeater.done());
}

TEST(MapResender, RestartsTheCycleForARequestDuringOne) {
  MapResender repeater;
  repeater.request(kMaps);
  for (int i = 0; i < 6; ++i) repeater.next(kMaps);
  repeater.request(kMaps);
  repeater.request(kMaps);
  const auto round = rest_of_round(repeater);
  EXPECT_EQ(round.size(), kMaps);
  EXPECT_EQ(std::set<std::size_t>(round.begin(), round.end()).size(), kMaps);
}

}  // namespace
}  // namespace adit
