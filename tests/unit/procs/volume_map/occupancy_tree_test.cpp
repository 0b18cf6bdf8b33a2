// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/volume_map/occupancy_tree.hpp"

#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/scratch_folder.hpp"
#include "tests/unit/procs/volume_map/octomap_reference.hpp"
#include "tests/unit/procs/volume_map/swept_tunnel.hpp"

namespace adit {
namespace {

using test::leaves;
using test::octomap_cells;
using test::sweep_of_tunnel;

constexpr double kCellM = 0.1;
constexpr double kRangeMaxM = 6.0;

/// Our tree and OctoMap's tree of the same scans.
class OccupancyTreeAgainstOctoMap : public testing::Test {
 protected:
  void insert(const Cloud& cloud) {
    test::insert(octomap_cells(cloud, kCellM, kRangeMaxM), reference_);
    ScanCells cells;
    for (const CloudLine& line : cloud.lines) {
      add_line(VoxelGrid(kCellM), line, kRangeMaxM, cells);
    }
    ours_.update(runs_of(cells.free, cells.occupied));
  }

  void expect_equal() {
    EXPECT_EQ(ours_.nodes(), reference_.size());
    const auto expected = leaves(reference_);
    EXPECT_GT(expected.size(), 1000U);
    EXPECT_TRUE(leaves(ours_, folder_ / "tree.ot") == expected);
  }

  test::ScratchFolder folder_;
  octomap::OcTree reference_{kCellM};
  OccupancyTree ours_{kCellM};
};

TEST_F(OccupancyTreeAgainstOctoMap, AreTheSameAfterAScan) {
  insert(sweep_of_tunnel({0.0, 0.0, 0.0}));
  expect_equal();
}

/// Pruned cells are expanded again, and others are pruned.
TEST_F(OccupancyTreeAgainstOctoMap, AreTheSameAfterScansFromSeveralPlaces) {
  for (int i = 0; i < 6; ++i) {
    insert(sweep_of_tunnel({0.5 * i, 0.2 * i, 0.9 * i}, 20));
    expect_equal();
  }
}

/// Log-odds are clamped at −2 for free cells and at 3.5 for occupied ones.
TEST_F(OccupancyTreeAgainstOctoMap, AreTheSameWhereLogOddsAreClamped) {
  for (int i = 0; i < 8; ++i) insert(sweep_of_tunnel({0.0, 0.0, 0.0}, 20));
  expect_equal();
  for (int i = 0; i < 3; ++i) insert(sweep_of_tunnel({0.3, -0.4, 0.2}, 20));
  expect_equal();
}

TEST_F(OccupancyTreeAgainstOctoMap, WriteTheSameStreamAfterPruning) {
  for (int i = 0; i < 3; ++i) insert(sweep_of_tunnel({0.5 * i, 0.2 * i, 0.9 * i}, 20));
  reference_.toMaxLikelihood();
  reference_.prune();
  std::ostringstream expected;
  reference_.writeBinaryData(expected);
  const auto stream = ours_.stream();
  EXPECT_TRUE(std::string(stream.begin(), stream.end()) == expected.str());
}

TEST_F(OccupancyTreeAgainstOctoMap, AreReadBackFromBtFiles) {
  for (int i = 0; i < 3; ++i) insert(sweep_of_tunnel({0.5 * i, 0.2 * i, 0.9 * i}, 20));
  ours_.write_bt(folder_ / "tree.bt");
  octomap::OcTree read(kCellM * 2);
  ASSERT_TRUE(read.readBinary((folder_ / "tree.bt").string()));
  EXPECT_EQ(read.getResolution(), kCellM);
  reference_.toMaxLikelihood();
  reference_.prune();
  EXPECT_TRUE(leaves(read) == leaves(reference_));
}

TEST(OccupancyTree, IsWrittenWhenEmpty) {
  const test::ScratchFolder folder;
  OccupancyTree tree(kCellM);
  tree.update({});
  EXPECT_TRUE(tree.stream().empty());
  tree.write_bt(folder / "tree.bt");
  octomap::OcTree read(kCellM);
  ASSERT_TRUE(read.readBinary((folder / "tree.bt").string()));
  EXPECT_EQ(read.size(), 0U);
  EXPECT_TRUE(leaves(tree, folder / "tree.ot").empty());
}

TEST(OccupancyTree, ReportsAnUnwritableFile) {
  const OccupancyTree tree(kCellM);
  EXPECT_THROW(tree.write_bt("/nonexistent/tree.bt"), std::runtime_error);
  EXPECT_THROW(tree.write_ot("/nonexistent/tree.ot"), std::runtime_error);
}

}  // namespace
}  // namespace adit
