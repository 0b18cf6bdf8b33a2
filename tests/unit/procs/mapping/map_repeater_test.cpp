// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/map_repeater.hpp"

#include <map>

#include <gtest/gtest.h>

namespace adit {
namespace {

std::vector<LocalMap> maps(int n) {
  std::vector<LocalMap> maps(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) maps[static_cast<std::size_t>(i)].id = i;
  return maps;
}

TEST(MapRepeater, GivesEachLocalMapOnceAndNeverMoreThanItMay) {
  MapRepeater repeater;
  const auto all = maps(10);
  EXPECT_TRUE(repeater.next(all, 4).empty());
  repeater.ask(all.size());
  std::vector<int> ids;
  while (!repeater.done()) {
    const auto pieces = repeater.next(all, 4);
    EXPECT_LE(pieces.size(), 4U);
    for (const LocalMapPiece& piece : pieces) ids.push_back(piece.part.id);
  }
  EXPECT_EQ(ids, (std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}));
}

TEST(MapRepeater, GoesRoundForWhoeverAsksInBetween) {
  MapRepeater repeater;
  const auto all = maps(10);
  repeater.ask(all.size());
  repeater.next(all, 6);
  repeater.ask(all.size());
  repeater.ask(all.size());
  std::map<int, int> times;
  while (!repeater.done()) {
    for (const LocalMapPiece& piece : repeater.next(all, 4)) ++times[piece.part.id];
  }
  EXPECT_EQ(times.size(), 10U);
  for (const auto& [id, n] : times) EXPECT_EQ(n, 1) << id;
}

}  // namespace
}  // namespace adit
