// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/volume_map/scan_cells.hpp"

#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "tests/unit/procs/volume_map/octomap_reference.hpp"
#include "tests/unit/procs/volume_map/swept_tunnel.hpp"

namespace adit {
namespace {

using Eigen::Vector3f;
using test::our_cells;

constexpr double kCellM = 0.1;
constexpr double kRangeMaxM = 6.0;

void expect_cells_of_octomap(const Cloud& cloud) {
  const auto cells = our_cells(cloud, kCellM, kRangeMaxM);
  EXPECT_GT(cells.free.size(), 100U);
  EXPECT_GT(cells.occupied.size(), 100U);
  EXPECT_TRUE(cells == test::octomap_cells(cloud, kCellM, kRangeMaxM));
}

Cloud cloud_of(std::vector<CloudLine> lines) {
  Cloud cloud;
  cloud.lines = std::move(lines);
  return cloud;
}

TEST(ScanCells, EqualThoseOfOctoMapForEachLine) {
  expect_cells_of_octomap(test::sweep_of_tunnel({1.0, 0.3, 0.4}));
}

TEST(ScanCells, EqualThoseOfOctoMapForRandomBeams) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> place(-1.0F, 1.0F);
  std::uniform_real_distribution<float> end(-8.0F, 8.0F);
  std::vector<CloudLine> lines(200);
  for (CloudLine& line : lines) {
    line.origin = {place(random), place(random), place(random)};
    for (int i = 0; i < 20; ++i) line.points.emplace_back(end(random), end(random), end(random));
  }
  expect_cells_of_octomap(cloud_of(lines));
}

/// Along axes and edges of cells, through their corners, within one cell.
TEST(ScanCells, EqualThoseOfOctoMapForBeamsWithTies) {
  std::mt19937 random(6);
  std::uniform_int_distribution<int> twentieths(-100, 100);
  const auto coordinate = [&] { return 0.05F * static_cast<float>(twentieths(random)); };
  std::vector<CloudLine> lines(200);
  for (CloudLine& line : lines) {
    line.origin = {coordinate(), coordinate(), coordinate()};
    const Vector3f& o = line.origin;
    for (int i = 0; i < 10; ++i) {
      const float d = coordinate();
      line.points.emplace_back(o.x() + d, o.y(), o.z());
      line.points.emplace_back(o.x(), o.y() + d, o.z());
      line.points.emplace_back(o.x() + d, o.y() + d, o.z() - d);
      line.points.emplace_back(coordinate(), coordinate(), coordinate());
      line.points.emplace_back(o + Vector3f::Constant(1e-4F * d));
    }
  }
  expect_cells_of_octomap(cloud_of(lines));
}

TEST(ScanCells, LieBetweenTheOriginAndThePoint) {
  const auto cells = our_cells(cloud_of({{0, {0.05F, 0.05F, 0.05F}, {{1.05F, 0.05F, 0.05F}}, {}}}),
                               kCellM, kRangeMaxM);
  EXPECT_EQ(cells.free.size(), 10U);
  ASSERT_EQ(cells.occupied.size(), 1U);
  EXPECT_EQ(VoxelGrid::keys_at(cells.occupied[0]), Eigen::Vector3i(32778, 32768, 32768));
}

TEST(ScanCells, BeyondTheRangeAreNotOccupied) {
  const auto cells = our_cells(cloud_of({{0, {0.05F, 0.05F, 0.05F}, {{20.0F, 0.05F, 0.05F}}, {}}}),
                               kCellM, kRangeMaxM);
  EXPECT_EQ(cells.free.size(), 60U);  // of 0.1 m, up to 6 m
  EXPECT_TRUE(cells.occupied.empty());
}

TEST(ScanCells, IgnoreBeamsWithoutReturn) {
  const auto cells =
      our_cells(cloud_of({{0, {0.0F, 0.0F, 0.0F}, {}, {{1.0F, 0.0F, 0.0F}}}}), kCellM, kRangeMaxM);
  EXPECT_TRUE(cells.free.empty());
  EXPECT_TRUE(cells.occupied.empty());
}

TEST(ScanCells, RejectInvalidPoints) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinite = std::numeric_limits<float>::infinity();
  ScanCells cells;
  const std::vector<Vector3f> points = {
      {kNaN, 0.0F, 0.0F}, {0.0F, kInfinite, 0.0F}, {0.0F, 0.0F, 3276.9F}, {-1e30F, 0.0F, 0.0F}};
  add_line(VoxelGrid(kCellM), {0, {0.0F, 0.0F, 0.0F}, points, {}}, kRangeMaxM, cells);
  EXPECT_EQ(cells.rejected_points, 4);
  add_line(VoxelGrid(kCellM), {0, {kNaN, 0.0F, 0.0F}, {{1.0F, 0.0F, 0.0F}}, {}}, kRangeMaxM, cells);
  EXPECT_EQ(cells.rejected_points, 5);
  EXPECT_EQ(cells.free.size(), 0U);
  EXPECT_EQ(cells.occupied.size(), 0U);
}

/// The traversal must not leave the grid.
TEST(ScanCells, ExtendToTheEndOfTheGrid) {
  ScanCells cells;
  add_line(VoxelGrid(kCellM), {0, {3276.0F, 0.0F, 0.0F}, {{3276.75F, 0.0F, 0.0F}}, {}}, kRangeMaxM,
           cells);
  add_line(VoxelGrid(kCellM), {0, {-3276.0F, 0.0F, 0.0F}, {{-3276.75F, 0.0F, 0.0F}}, {}},
           kRangeMaxM, cells);
  EXPECT_EQ(cells.rejected_points, 0);
  EXPECT_EQ(cells.occupied.size(), 2U);
}

}  // namespace
}  // namespace adit
