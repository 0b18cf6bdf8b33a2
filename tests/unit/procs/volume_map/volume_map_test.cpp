// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/volume_map/volume_map.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "common/volume/volume.hpp"
#include "tests/unit/procs/volume_map/swept_tunnel.hpp"

namespace adit {
namespace {

/// A true scan with the pose error of odometry.
Cloud scan_at(const Pose2& T_world_level, const Pose2& T_odom_level, std::int32_t id = 0) {
  Cloud cloud = test::sweep_of_tunnel(T_world_level, 30);
  cloud.T_odom_level = T_odom_level;
  cloud.id = id;
  return cloud;
}

MapGraph graph_of(std::int64_t revision, std::vector<Pose2> poses) {
  return {0, revision, std::move(poses), {}};
}

MapCorrection correction(std::int64_t revision, int local_map, const Pose2& T_map_odom) {
  return {0, revision, 0, local_map, T_map_odom, {}};
}

std::vector<VoxelCode> cells(const VolumeMap& map, bool occupied) {
  std::vector<VoxelCode> found;
  visit_leaves(map.merged().stream(), [&](const CellRun& leaf) {
    for (VoxelCode cell = leaf.first; leaf.occupied == occupied && cell < leaf.end; ++cell) {
      found.push_back(cell);
    }
  });
  return found;
}

/// Distance of the farthest occupied cell from the walls, floor, roof and ends of the tunnel [m].
double farthest_from_rock_m(const VolumeMap& map) {
  const VoxelGrid grid(0.1);
  double farthest = 0.0;
  for (const VoxelCode cell : cells(map, true)) {
    const Eigen::Vector3d p = grid.centre_m(VoxelGrid::keys_at(cell));
    const double from_rock =
        std::min({std::abs(2.0 - std::abs(p.y())), std::abs(20.0 - std::abs(p.x())),
                  std::abs(p.z()), std::abs(2.0 - p.z())});
    farthest = std::max(farthest, from_rock);
  }
  return farthest;
}

const Pose2 kStart{};
const Pose2 kSecond{9.0, 0.2, 0.1};                        // true pose
const Pose2 kDrifted{9.4, 1.3, 0.18};                      // pose by odometry
constexpr double kResampledM = 0.1 * std::numbers::sqrt3;  // twice half the diagonal of a cell

/// The first scan in local map 0, the second in local map 1, before the loop closure.
VolumeMap drifted_map() {
  VolumeMap map{VolumeMapParams{}};
  map.set_graph(graph_of(1, {kStart}));
  map.set_correction(correction(1, 0, {}));
  map.add(scan_at(kStart, kStart, 1));
  map.set_graph(graph_of(2, {kStart, kDrifted}));
  map.set_correction(correction(2, 1, {}));
  map.add(scan_at(kSecond, kDrifted, 2));
  return map;
}

TEST(VolumeMap, HasASubVolumePerLocalMap) {
  const VolumeMap map = drifted_map();
  ASSERT_EQ(map.volumes().size(), 2U);
  EXPECT_EQ(map.volumes()[0].anchor->local_map, 0);
  EXPECT_EQ(map.volumes()[1].anchor->local_map, 1);
  EXPECT_FALSE(map.volumes()[0].volume.is_open());
  EXPECT_TRUE(map.volumes()[1].volume.is_open());
  EXPECT_GT(farthest_from_rock_m(map), 0.5);  // the second one is misaligned
}

TEST(VolumeMap, AppliesALoopClosureWithoutInsertingAgain) {
  VolumeMap map = drifted_map();
  const auto octree = map.volumes()[1].volume.octree();
  map.set_graph(graph_of(3, {kStart, kSecond}));
  EXPECT_EQ(map.volumes()[1].volume.scans(), 1);
  EXPECT_EQ(map.volumes()[1].volume.octree(), octree);
  const Pose2& T_map_volume = map.volumes()[1].T_map_volume.plan;
  EXPECT_NEAR(T_map_volume.x, kSecond.x, 1e-12);
  EXPECT_NEAR(T_map_volume.y, kSecond.y, 1e-12);
  EXPECT_NEAR(T_map_volume.theta, kSecond.theta, 1e-12);
  EXPECT_LT(farthest_from_rock_m(map), kResampledM);
}

TEST(VolumeMap, MovesCellsWithTheGraph) {
  VolumeMap map = drifted_map();
  map.set_graph(graph_of(3, {kStart, kSecond}));
  const auto occupied = cells(map, true);
  const auto free = cells(map, false);
  // All poses rotated by a quarter turn and moved by 30 cells along x and −20 along y of map.
  const Pose2 motion{3.0, -2.0, std::numbers::pi / 2.0};
  map.set_graph(graph_of(4, {motion * kStart, motion * kSecond}));
  const auto moved = [](const std::vector<VoxelCode>& before) {
    std::vector<VoxelCode> after;
    for (const VoxelCode cell : before) {
      const Eigen::Vector3i k = VoxelGrid::keys_at(cell);
      const int x_origin = VoxelGrid::kKeyOfOrigin;
      after.push_back(VoxelGrid::code_of({2 * x_origin - 1 - k.y() + 30, k.x() - 20, k.z()}));
    }
    std::sort(after.begin(), after.end());
    return after;
  };
  EXPECT_EQ(cells(map, true), moved(occupied));
  EXPECT_EQ(cells(map, false), moved(free));
}

TEST(VolumeMap, AnchorsScansFromBeforeTheFirstGraph) {
  VolumeMap map{VolumeMapParams{}};
  map.add(scan_at(kStart, kStart));
  map.add(scan_at({1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}));
  ASSERT_EQ(map.volumes().size(), 1U);
  EXPECT_FALSE(map.volumes()[0].anchor);
  EXPECT_EQ(map.volumes()[0].volume.scans(), 2);
  const Pose2 T_map_odom{5.0, -2.0, 1.0};
  const Pose2 T_odom_local{0.5, 0.0, 0.1};
  map.set_correction(correction(1, 0, T_map_odom));
  EXPECT_FALSE(map.volumes()[0].anchor);  // unknown without the graph
  map.set_graph(graph_of(1, {T_map_odom * T_odom_local}));
  ASSERT_TRUE(map.volumes()[0].anchor);
  const Pose2 expected = T_map_odom * kStart;
  EXPECT_NEAR(map.volumes()[0].T_map_volume.plan.x, expected.x, 1e-12);
  EXPECT_NEAR(map.volumes()[0].T_map_volume.plan.y, expected.y, 1e-12);
  EXPECT_NEAR(map.volumes()[0].anchor->T_local_volume.plan.x, T_odom_local.inverse().x, 1e-12);
}

/// A correction and poses of different graphs would misplace it.
TEST(VolumeMap, WaitsForACorrectionAndAGraphOfTheSameRevision) {
  VolumeMap map{VolumeMapParams{}};
  map.add(scan_at(kStart, kStart));
  map.set_graph(graph_of(1, {kStart}));
  map.set_correction(correction(2, 0, {1.0, 0.0, 0.0}));
  EXPECT_FALSE(map.volumes()[0].anchor);
  map.set_graph(graph_of(2, {{1.0, 0.0, 0.0}}));
  ASSERT_TRUE(map.volumes()[0].anchor);
  EXPECT_EQ(map.volumes()[0].T_map_volume.plan, (Pose2{1.0, 0.0, 0.0}));
}

TEST(VolumeMap, CombinesNearScansOfOneLocalMap) {
  VolumeMap map{VolumeMapParams{}};
  map.set_graph(graph_of(1, {kStart}));
  map.set_correction(correction(1, 0, {}));
  for (const double x : {0.0, 3.0, 9.9, 10.1}) map.add(scan_at({x, 0.0, 0.0}, {x, 0.0, 0.0}));
  ASSERT_EQ(map.volumes().size(), 2U);
  EXPECT_EQ(map.volumes()[0].volume.scans(), 3);
  EXPECT_NEAR(map.volumes()[1].T_map_volume.plan.x, 10.1, 1e-12);
  EXPECT_LT(farthest_from_rock_m(map), kResampledM);
}

TEST(VolumeMap, DoesNotMoveVolumesThatAreNotInTheGraph) {
  VolumeMap map = drifted_map();
  map.set_graph(graph_of(3, {kSecond}));
  EXPECT_EQ(map.volumes()[0].T_map_volume.plan, kSecond);
  EXPECT_NEAR(map.volumes()[1].T_map_volume.plan.x, kDrifted.x, 1e-12);
}

/// Rotated cells leave no holes in free space.
TEST(VolumeMap, HasNoHolesInFreeSpaceWhenMerged) {
  VolumeMap map{VolumeMapParams{}};
  map.add(scan_at(kStart, {0.03, 0.04, 0.6}));
  const auto free = cells(map, false);
  const auto is_free = [&](const Eigen::Vector3d& p_level) {
    const Eigen::Vector2d p_map = Pose2{0.03, 0.04, 0.6} * Eigen::Vector2d(p_level.head<2>());
    const auto keys =
        VoxelGrid(0.1).keys_of({static_cast<float>(p_map.x()), static_cast<float>(p_map.y()),
                                static_cast<float>(p_level.z())});
    return std::binary_search(free.begin(), free.end(), VoxelGrid::code_of(*keys));
  };
  for (double x = 1.6; x < 2.2; x += 0.03) {  // traversed by beams to the floor
    for (double y = -0.4; y < 0.4; y += 0.03) EXPECT_TRUE(is_free({x, y, 0.35})) << x << " " << y;
  }
}

}  // namespace
}  // namespace adit
