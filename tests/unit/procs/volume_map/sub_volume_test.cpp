// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/volume_map/sub_volume.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "common/volume/volume.hpp"
#include "tests/unit/procs/volume_map/octomap_reference.hpp"
#include "tests/unit/procs/volume_map/swept_tunnel.hpp"

namespace adit {
namespace {

using test::sweep_of_tunnel;

SubVolume volume_of(const Cloud& cloud, const Pose2& T_volume_level = {}) {
  SubVolume volume{SubVolumeParams{}};
  volume.insert(cloud, {T_volume_level, 0.0});
  return volume;
}

test::OctoMapCells cells_of(const SubVolume& volume) {
  test::OctoMapCells cells;
  visit_leaves(volume.octree(), [&](const CellRun& leaf) {
    for (VoxelCode cell = leaf.first; cell < leaf.end; ++cell) {
      (leaf.occupied ? cells.occupied : cells.free).push_back(cell);
    }
  });
  return cells;
}

TEST(SubVolume, ContainsTheCellsOfItsScan) {
  const Cloud cloud = sweep_of_tunnel({2.0, 0.5, 0.3});
  const SubVolume volume = volume_of(cloud);
  const SubVolumeParams params;
  EXPECT_TRUE(cells_of(volume) == test::octomap_cells(cloud, params.cell_m, params.range_max_m));
  EXPECT_EQ(volume.occupied(), static_cast<std::int64_t>(cells_of(volume).occupied.size()));
  EXPECT_EQ(volume.free(), static_cast<std::int64_t>(cells_of(volume).free.size()));
  EXPECT_EQ(volume.utime(), cloud.utime);
}

TEST(SubVolume, IsOccupiedAtRockAndFreeElsewhere) {
  const SubVolume volume = volume_of(sweep_of_tunnel({0.0, 0.0, 0.0}));
  const VoxelGrid grid(volume.cell_m());
  const auto depth_in_rock = [&](VoxelCode cell) {
    const Eigen::Vector3d p = grid.centre_m(VoxelGrid::keys_at(cell));
    return std::max({std::abs(p.x()) - 20.0, std::abs(p.y()) - 2.0, -p.z(), p.z() - 2.0});
  };
  constexpr double kHalf = 0.052;  // half a cell, half a unit of the laser, single precision
  for (const VoxelCode cell : cells_of(volume).occupied) {
    EXPECT_NEAR(depth_in_rock(cell), 0.0, kHalf);
  }
  for (const VoxelCode cell : cells_of(volume).free) EXPECT_LT(depth_in_rock(cell), kHalf);
}

TEST(SubVolume, CombinesScansFromSeveralPlaces) {
  SubVolume volume{SubVolumeParams{}};
  const Pose2 T_world_volume{2.0, 0.5, 0.3};
  const Pose2 T_world_level{3.0, -0.5, -0.4};
  volume.insert(sweep_of_tunnel(T_world_volume), {});
  const std::int64_t before = volume.free();
  volume.insert(sweep_of_tunnel(T_world_level), {between(T_world_volume, T_world_level), 0.0});
  EXPECT_EQ(volume.scans(), 2);
  EXPECT_GT(volume.free(), before);
  const VoxelGrid grid(volume.cell_m());
  for (const VolumePoint& point : volume.points()) {
    const Eigen::Vector3f& p = point.p_volume;
    const Eigen::Vector2d p_world = T_world_volume * Eigen::Vector2d(p.x(), p.y());
    const double to_rock = std::min({2.0 - std::abs(p_world.y()), 20.0 - std::abs(p_world.x()),
                                     static_cast<double>(p.z()), 2.0 - p.z()});
    ASSERT_NEAR(to_rock, 0.0, 0.002);  // half a unit of 1 mm, and single precision at 20 m
  }
}

TEST(SubVolume, StoresOnePointPerSmallCell) {
  const Cloud cloud = sweep_of_tunnel({0.0, 0.0, 0.0});
  const SubVolume volume = volume_of(cloud);
  EXPECT_LT(volume.points().size(), cloud.points());
  EXPECT_GT(volume.points().size(), cloud.points() / 4);
  const VoxelGrid grid(SubVolumeParams{}.point_spacing_m);
  CellSet observed;
  for (const VolumePoint& point : volume.points()) {
    EXPECT_TRUE(observed.insert(VoxelGrid::code_of(*grid.keys_of(point.p_volume))));
    EXPECT_EQ(point.scan, cloud.id);
  }
}

TEST(SubVolume, AcceptsAnEmptyScan) {
  const SubVolume volume = volume_of({});
  EXPECT_EQ(volume.scans(), 1);
  EXPECT_TRUE(volume.octree().empty());
  EXPECT_TRUE(volume.points().empty());
}

TEST(SubVolume, AcceptsAnIncompleteScan) {
  Cloud cloud = sweep_of_tunnel({0.0, 0.0, 0.0});
  const std::int64_t all = volume_of(cloud).free();
  cloud.complete = false;
  cloud.lines.resize(cloud.lines.size() / 2);
  const std::int64_t half = volume_of(cloud).free();
  EXPECT_GT(half, 0);
  EXPECT_LT(half, all);
}

TEST(SubVolume, RejectsInvalidPoints) {
  Cloud cloud = sweep_of_tunnel({0.0, 0.0, 0.0});
  const SubVolume expected = volume_of(cloud);
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  cloud.lines.back().points.emplace_back(kNaN, 1.0F, 1.0F);
  cloud.lines.back().points.emplace_back(1e9F, 1.0F, 1.0F);
  for (const float x : {kNaN, 11.0F}) {
    cloud.lines.push_back({0, {x, 0.0F, 0.0F}, {{1.0F, 0.0F, 0.0F}}, {}});
  }
  const SubVolume volume = volume_of(cloud);
  EXPECT_EQ(volume.rejected_points(), 4);
  EXPECT_EQ(volume.octree(), expected.octree());
  EXPECT_EQ(volume.points().size(), expected.points().size());
}

TEST(SubVolume, RetainsItsCellsWhenClosed) {
  SubVolume volume = volume_of(sweep_of_tunnel({0.0, 0.0, 0.0}));
  const auto octree = volume.octree();
  const std::size_t points = volume.points().size();
  volume.close();
  EXPECT_FALSE(volume.is_open());
  EXPECT_EQ(volume.octree(), octree);
  EXPECT_EQ(volume.points().size(), points);
}

}  // namespace
}  // namespace adit
