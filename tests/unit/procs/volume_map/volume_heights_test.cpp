// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "procs/volume_map/volume_journal.hpp"
#include "procs/volume_map/volume_map.hpp"
#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

constexpr double kGrade = 0.2;
constexpr double kCellM = 0.1;
constexpr std::int64_t kUtime = 1'600'000'000'000'000;

/// The floor of a ramp along x of world, seen from a body on it at x: odom is world.
Cloud scan_of_ramp(double x, std::int32_t id) {
  CloudLine line{kUtime, {0.0F, 0.0F, 1.0F}, {}, {}};
  for (double ahead = 1.0; ahead < 6.0; ahead += 0.1) {
    for (const double y : {-0.5, 0.5}) {
      line.points.emplace_back(static_cast<float>(ahead), static_cast<float>(y),
                               static_cast<float>(kGrade * ahead));
    }
  }
  return {kUtime + id, id, {x, 0.0, 0.0}, true, {line}, kGrade * x};
}

/// A local map each 10 m along the ramp, up to `x_m`, with odom in map at a height.
void place(VolumeMap& map, std::int64_t revision, double x_m, double z_map_odom_m = 0.0) {
  MapGraph graph{kUtime, revision, {}, {}};
  for (double x = 0.0; x <= x_m; x += 10.0) {
    graph.poses.push_back({x, 0.0, 0.0});
    graph.z_m.push_back(kGrade * x + z_map_odom_m);
  }
  const auto newest = static_cast<int>(graph.poses.size()) - 1;
  map.set_graph(graph);
  map.set_correction({kUtime, revision, 0, newest, {}, {}, z_map_odom_m});
}

/// A drive up the ramp: two scans in the first sub-volume, one in the second.
void drive_up(VolumeMap& map) {
  place(map, 1, 0.0);
  map.add(scan_of_ramp(0.0, 1));
  map.add(scan_of_ramp(5.0, 2));
  place(map, 2, 10.0);
  map.add(scan_of_ramp(11.0, 3));
}

/// The largest distance of a point from the ramp, of which the origin of odom is at `z_m`.
double largest_error_m(const VolumeMap& map, double z_m = 0.0) {
  double largest = 0.0;
  for (const PlacedVolume& placed : map.volumes()) {
    for (const VolumePoint& point : placed.volume.points()) {
      const Eigen::Vector3d p =
          placed.T_map_volume * Eigen::Vector3d(point.p_volume.cast<double>());
      largest = std::max(largest, std::abs(p.z() - kGrade * p.x() - z_m));
    }
  }
  return largest;
}

constexpr double kSinglePrecisionM = 1e-5;

TEST(VolumeHeights, MakeOneContinuousFloorOfARamp) {
  VolumeMap map{VolumeMapParams{}};
  drive_up(map);
  ASSERT_EQ(map.volumes().size(), 2U);
  EXPECT_EQ(map.volumes()[0].volume.scans(), 2);
  EXPECT_NEAR(map.volumes()[1].T_map_volume.z_m, 11.0 * kGrade, 1e-12);
  EXPECT_LT(largest_error_m(map), kSinglePrecisionM);
}

TEST(VolumeHeights, AreThoseOfTheMergedTree) {
  VolumeMap map{VolumeMapParams{}};
  drive_up(map);
  const VoxelGrid grid(kCellM);
  int cells = 0;
  visit_leaves(map.merged().stream(), [&](const CellRun& leaf) {
    for (VoxelCode cell = leaf.first; leaf.occupied && cell < leaf.end; ++cell) {
      const Eigen::Vector3d p = grid.centre_m(VoxelGrid::keys_at(cell));
      // Half a cell along each axis in the sub-volume, and again in map.
      EXPECT_NEAR(p.z(), kGrade * p.x(), kCellM * (1.0 + kGrade)) << p.x();
      ++cells;
    }
  });
  EXPECT_GT(cells, 200);
}

TEST(VolumeHeights, FollowTheHeightsOfTheGraph) {
  VolumeMap map{VolumeMapParams{}};
  drive_up(map);
  const auto octree = map.volumes()[1].volume.octree();
  MapGraph graph{kUtime, 3, {{}, {10.0, 0.0, 0.0}}, {}};
  graph.z_m = {0.0, 3.5};
  map.set_graph(graph);
  EXPECT_NEAR(map.volumes()[0].T_map_volume.z_m, 0.0, 1e-12);
  EXPECT_NEAR(map.volumes()[1].T_map_volume.z_m, 3.5 + 1.0 * kGrade, 1e-12);
  EXPECT_EQ(map.volumes()[1].volume.octree(), octree);
}

TEST(VolumeHeights, SurviveARestart) {
  const test::ScratchFolder folder;
  {
    VolumeMap map{VolumeMapParams{}};
    map.set_odom_epoch(kUtime);
    drive_up(map);
    VolumeJournal(folder / "volume.journal").store(map);
  }
  VolumeMap again{VolumeMapParams{}};
  again.restore(VolumeJournal(folder / "volume.journal").take_restored());
  again.set_odom_epoch(kUtime);
  again.add(scan_of_ramp(16.0, 4));  // anchored by the stored odom frame
  place(again, 2, 10.0);
  ASSERT_EQ(again.volumes().size(), 3U);
  EXPECT_LT(largest_error_m(again), kSinglePrecisionM);
  place(again, 3, 10.0, -7.0);
  EXPECT_LT(largest_error_m(again, -7.0), kSinglePrecisionM);
}

TEST(VolumeHeights, KeepAScanBelowThatOfAnotherLevel) {
  VolumeMapParams params;
  params.replace_radius_m = 2.0;
  VolumeMap map{params};
  place(map, 1, 0.0);
  Cloud above = scan_of_ramp(0.0, 1);
  above.z_odom_m = 4.0;
  map.add(above);
  map.add(scan_of_ramp(12.0, 2));
  map.add(scan_of_ramp(0.0, 3));
  ASSERT_EQ(map.volumes().size(), 3U);
  EXPECT_EQ(map.volumes()[0].volume.points().front().scan, 1);
}

}  // namespace
}  // namespace adit
