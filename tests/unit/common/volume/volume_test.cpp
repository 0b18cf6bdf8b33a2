// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/volume/volume.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace adit {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::int64_t kEighth = std::int64_t{1} << 45U;  // of the cells of the cube

/// A chain of first children that ends in `last`.
Bytes chain(std::size_t length, std::uint8_t last) {
  Bytes bytes(2 * length + 2, 0x00);
  for (std::size_t i = 0; i < length; ++i) bytes[2 * i] = 0x03;
  bytes[2 * length] = last;
  return bytes;
}

TEST(OctreeStream, VisitsTheLeavesInOrder) {
  // Of the root: child 0 free, 1 with children, 2 occupied. Of child 1: child 7 occupied.
  const Bytes bytes = {0b00101101, 0x00, 0x00, 0x80};
  std::vector<CellRun> leaves;
  EXPECT_EQ(visit_leaves(bytes, [&](const CellRun& leaf) { leaves.push_back(leaf); }), "");
  constexpr VoxelCode kChild = cells_of_node(1);
  const std::vector<CellRun> expected = {{0, kChild, false},
                                         {2 * kChild - cells_of_node(2), 2 * kChild, true},
                                         {2 * kChild, 3 * kChild, true}};
  EXPECT_EQ(leaves, expected);
}

TEST(OctreeStream, CountsCells) {
  const OctreeCounts counts = count_cells(Bytes{0x01, 0x80});
  EXPECT_EQ(counts.rejection, "");
  EXPECT_EQ(counts.free, kEighth);
  EXPECT_EQ(counts.occupied, kEighth);
}

TEST(OctreeStream, TreatsNoBytesAsUnknown) {
  const OctreeCounts counts = count_cells({});
  EXPECT_EQ(counts.rejection, "");
  EXPECT_EQ(counts.free + counts.occupied, 0);
}

TEST(OctreeStream, ReachesSingleCells) { EXPECT_EQ(count_cells(chain(15, 0x01)).free, 1); }

TEST(OctreeStream, RejectsDamagedData) {
  EXPECT_EQ(count_cells(chain(16, 0x01)).rejection, "octree deeper than the limit");
  EXPECT_EQ(count_cells(chain(100'000, 0x01)).rejection, "octree deeper than the limit");
  EXPECT_EQ(count_cells(chain(3, 0x03)).rejection, "octree truncated");
  EXPECT_EQ(count_cells(Bytes{0x01}).rejection, "octree truncated");
  EXPECT_EQ(count_cells(chain(3, 0x00)).rejection, "octree with an empty branch");
  EXPECT_EQ(count_cells(Bytes{0x01, 0x00, 0x01}).rejection, "octree with trailing bytes");
  EXPECT_EQ(count_cells(Bytes(kOctreeBytesMax + 1)).rejection, "octree larger than plausible");
}

}  // namespace
}  // namespace adit
