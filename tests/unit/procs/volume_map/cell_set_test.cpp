// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "procs/volume_map/scan_cells.hpp"

namespace adit {
namespace {

TEST(CellSet, ContainsEachCellOnce) {
  CellSet set;
  EXPECT_TRUE(set.insert(5));
  EXPECT_FALSE(set.insert(5));
  EXPECT_TRUE(set.insert((VoxelCode{1} << 48U) - 1));
  EXPECT_EQ(set.size(), 2U);
  EXPECT_TRUE(set.contains(5));
  EXPECT_FALSE(set.contains(6));
  EXPECT_FALSE(set.contains(VoxelCode{5} << 20U));
}

TEST(CellRuns, AreMaximal) {
  CellSet free;
  CellSet occupied;
  for (VoxelCode cell = 100; cell < 70'000; ++cell) free.insert(cell);  // across blocks
  occupied.insert(300);
  const std::vector<CellRun> expected = {{100, 300, false}, {300, 301, true}, {301, 70'000, false}};
  EXPECT_EQ(runs_of(free, occupied), expected);
}

/// Compares with sets of the standard library.
TEST(CellRuns, ContainAllCellsInOrderAndPreferOccupied) {
  std::mt19937_64 random(3);
  CellSet free;
  CellSet occupied;
  std::set<VoxelCode> all;
  std::set<VoxelCode> all_occupied;
  for (int i = 0; i < 60'000; ++i) {
    const VoxelCode cell = random() % 100'000 + (i % 2 == 0 ? VoxelCode{1} << 40U : 0);
    all.insert(cell);
    if (i % 3 == 0) all_occupied.insert(cell);
    (i % 3 == 0 ? occupied : free).insert(cell);
  }
  auto next = all.begin();
  for (const CellRun& run : runs_of(free, occupied)) {
    for (VoxelCode cell = run.first; cell < run.end; ++cell, ++next) {
      ASSERT_EQ(cell, *next);
      ASSERT_EQ(run.occupied, all_occupied.contains(cell));
    }
  }
  EXPECT_EQ(next, all.end());
}

TEST(VoxelCode, ConvertsBackToItsKeys) {
  std::mt19937 random(4);
  for (int i = 0; i < 1000; ++i) {
    const VoxelGrid::Keys keys(static_cast<int>(random() % 65536),
                               static_cast<int>(random() % 65536),
                               static_cast<int>(random() % 65536));
    EXPECT_EQ(VoxelGrid::keys_at(VoxelGrid::code_of(keys)), keys);
  }
}

}  // namespace
}  // namespace adit
