// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/terrain/memory/terrain_memory.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/unit/procs/terrain/terrain_scenes.hpp"

namespace adit {
namespace {

// Error of a height: the noise of one scan as in the tests of the terrain, and as much of the
// other.
constexpr double kNoise = 0.04;  // on slopes also half a cell, at their grade
const Pose2 kFirst{-6.0, 0.0, 0.0};
const Pose2 kHere{0.0, 0.0, 0.0};
/// Around the vehicle at kHere, where no beam of its front laser hits the ground.
const Eigen::AlignedBox2d kBlind(Eigen::Vector2d(-2.4, -1.5), Eigen::Vector2d(1.9, 1.5));

bool is_even(const TerrainCell& cell) {
  return cell.ground == Ground::kObserved && cell.coefficient_m < 0.15;
}

ScanningVehicle::Build tunnel_with(const ScanningVehicle::Build& add) {
  return [add](MeshBuilder& builder) {
    add_tunnel(builder);
    add(builder);
  };
}

ScanningVehicle::Build tunnel_with_rock(const Eigen::Vector3d& middle,
                                        const Eigen::Vector3d& size) {
  return tunnel_with([=](MeshBuilder& builder) { add_rock(builder, middle, size); });
}

TEST(TerrainMemory, FillsHolesOfASecondScanFromTheFirst) {
  ScanningVehicle vehicle(kFirst);
  vehicle.scan(add_tunnel);
  vehicle.drive_to(kHere);
  const TerrainMap map = vehicle.scan(add_tunnel);
  EXPECT_EQ(share_of(map, kBlind, is_even), 1.0);
  for_cells(map, kBlind, [](const TerrainCell& cell) { EXPECT_NEAR(cell.low_m, 0.0, kNoise); });
  EXPECT_EQ(vehicle.memory().recall_result().used, 1);
  EXPECT_EQ(vehicle.memory().recall_result().changed, 0);
}

TEST(TerrainMemory, DoesNotChangeASingleScan) {
  ScanningVehicle vehicle(kHere);
  const TerrainMap map = vehicle.scan(add_tunnel);
  const TerrainMap single_scan = Terrain({}).make(cloud_of(add_tunnel));
  const auto is_seen = [](const TerrainCell& cell) { return cell.ground == Ground::kObserved; };
  const Eigen::AlignedBox2d behind(Eigen::Vector2d(-6.0, -1.5), Eigen::Vector2d(-1.3, 1.5));
  EXPECT_EQ(share_of(map, behind, is_seen), 0.0);
  const Eigen::AlignedBox2d ahead(Eigen::Vector2d(2.5, -1.5), Eigen::Vector2d(8.0, 1.5));
  EXPECT_EQ(share_of(map, ahead, is_seen), share_of(single_scan, ahead, is_seen));
}

TEST(TerrainMemory, CombinesScansOfBothLasersFromOnePlace) {
  ScanningVehicle vehicle(kHere);
  vehicle.scan(add_tunnel);
  const TerrainMap map = vehicle.scan(add_tunnel, true);
  const Eigen::AlignedBox2d ahead(Eigen::Vector2d(2.5, -1.5), Eigen::Vector2d(5.5, 1.5));
  const Eigen::AlignedBox2d behind(Eigen::Vector2d(-10.0, -1.5), Eigen::Vector2d(-2.5, 1.5));
  EXPECT_EQ(share_of(map, ahead, is_even), 1.0);
  EXPECT_EQ(share_of(map, behind, is_even), 1.0);
  EXPECT_NEAR(map.p_level_corner.x(), -14.0,
              map.cell_m);  // 6 m of the map lie behind the rear laser
}

TEST(TerrainMemory, TransfersHeightsOnRisingGround) {
  for (const double grade : {0.06, 0.25}) {
    const auto ramp = [&](MeshBuilder& builder) {
      const auto corner = [&](float x, float y) {
        return builder.vertex({x, y, static_cast<float>(grade) * x});
      };
      builder.quad(corner(-15, -2), corner(15, -2), corner(15, 2), corner(-15, 2));
    };
    ScanningVehicle vehicle(kFirst);
    vehicle.scan(ramp, false, grade * kFirst.x);
    vehicle.drive_to(kHere);
    const TerrainMap map = vehicle.scan(ramp);
    EXPECT_EQ(share_of(map, kBlind, is_even), 1.0) << grade;
    for (double x = -2.35; x < 1.9; x += 0.1) {
      EXPECT_NEAR(cell_at(map, x, 0.35).low_m, grade * x, kNoise + 0.05 * grade)
          << grade << " at " << x;
    }
  }
}

TEST(TerrainMemory, TransfersHeightsOverAChangeOfSlope) {
  constexpr double kGrade = 0.25;
  constexpr float kFoot = -2.0F;
  const auto height = [&](double x) { return kGrade * std::max(x - kFoot, 0.0); };
  const auto ramp = [&](MeshBuilder& builder) {
    const auto corner = [&](float x, float y) {
      return builder.vertex({x, y, static_cast<float>(height(x))});
    };
    builder.quad(corner(-15, -2), corner(kFoot, -2), corner(kFoot, 2), corner(-15, 2));
    builder.quad(corner(kFoot, -2), corner(15, -2), corner(15, 2), corner(kFoot, 2));
  };
  ScanningVehicle vehicle(kFirst);
  vehicle.scan(ramp, false, height(kFirst.x));
  vehicle.drive_to(kHere);
  const TerrainMap map = vehicle.scan(ramp, false, height(0.0));
  EXPECT_EQ(vehicle.memory().recall_result().rejected, 0);
  EXPECT_EQ(share_of(map, kBlind, is_even), 1.0);
  for (double x = -2.35; x < 1.9; x += 0.1) {
    EXPECT_NEAR(cell_at(map, x, 0.35).low_m, height(x) - height(0.0), kNoise + 0.05 * kGrade) << x;
  }
}

/// Level ground as single scans observe it, heights of the roof in place of clearances.
TerrainMap level_ground(std::int64_t utime) {
  TerrainCell cell;
  cell.ground = Ground::kObserved;
  cell.count = 20;
  cell.clearance_m = 2.0F;
  TerrainMap map;
  map.utime = utime;
  map.cell_m = 0.1;
  map.p_level_corner = {-5.0, -5.0};
  map.cells = Grid2<TerrainCell>(100, 100, cell);
  return map;
}

/// The first scan shows the floor; of one region the second shows only what hangs over it.
TerrainCell recalled_below(float hanging_m) {
  TerrainMemory memory({});
  TerrainMap first = level_ground(1'000'000);
  memory.recall(first);
  TerrainMap second = level_ground(2'000'000);
  TerrainCell& cell = second.cells.at({70, 50});
  cell.low_m = cell.high_m = hanging_m;
  cell.clearance_m = std::numeric_limits<float>::infinity();
  memory.recall(second);
  EXPECT_EQ(memory.recall_result().used, 1);
  return cell;
}

TEST(TerrainMemory, DoesNotTakeARoofForAnObstacleOnEarlierGround) {
  const TerrainCell cell = recalled_below(1.9F);
  EXPECT_EQ(cell.low_m, 0.0F);
  EXPECT_EQ(cell.high_m, 0.0F);
  EXPECT_EQ(cell.clearance_m, 1.9F);
}

TEST(TerrainMemory, AddsAnObstacleToEarlierGround) {
  const TerrainCell cell = recalled_below(0.9F);
  EXPECT_EQ(cell.low_m, 0.0F);
  EXPECT_EQ(cell.high_m, 0.9F);
}

TEST(TerrainMemory, RetainsObstaclesOutsideTheFieldOfView) {
  const auto tunnel = tunnel_with_rock({1.5, 0.9, 0.25}, {0.4, 0.4, 0.5});
  ScanningVehicle vehicle(kFirst);
  vehicle.scan(tunnel);
  vehicle.drive_to(kHere);
  const TerrainMap map = vehicle.scan(tunnel);
  for (const double y : {0.75, 0.95}) {
    EXPECT_NEAR(cell_at(map, 1.35, y).coefficient_m, 0.5, 0.1) << y;  // the observed face
  }
}

TEST(TerrainMemory, RetainsADrop) {
  const auto pit = [](MeshBuilder& builder) {
    add_ground(builder, -15.0, 1.3);
    add_ground(builder, 1.3, 2.3, -1.0);
    add_ground(builder, 2.3, 15.0);
  };
  ScanningVehicle vehicle({-3.0, 0.0, 0.0});
  vehicle.scan(pit);
  vehicle.drive_to(kHere);
  const TerrainMap map = vehicle.scan(pit);
  const Eigen::AlignedBox2d in_it(Eigen::Vector2d(1.5, -1.0), Eigen::Vector2d(1.9, 1.0));
  EXPECT_EQ(share_of(map, in_it, is_even), 0.0);
  EXPECT_EQ(cell_at(map, 1.75, 0.0).ground, Ground::kBelowRay);
}

/// A rock of 1.2 m, higher than the laser, and the share of its footprint that a single scan of it
/// classifies as ground: some cells along its sides, which beams pass closely.
const ScanningVehicle::Build kFallen = tunnel_with_rock({4.0, 0.0, 0.4}, {1.2, 1.2, 0.8});
const Eigen::AlignedBox2d kPlan(Eigen::Vector2d(3.4, -0.6), Eigen::Vector2d(4.6, 0.6));

double even_share_alone() { return share_of(Terrain({}).make(cloud_of(kFallen)), kPlan, is_even); }

TEST(TerrainMemory, AddsAFallenRockWithItsOccludedPart) {
  ScanningVehicle vehicle(kFirst);
  vehicle.scan(add_tunnel);
  vehicle.drive_to(kHere);
  const TerrainMap map = vehicle.scan(kFallen);
  EXPECT_GT(cell_at(map, 3.45, 0.0).coefficient_m, 0.5);
  EXPECT_EQ(share_of(map, kPlan, is_even), even_share_alone());
  EXPECT_GT(vehicle.memory().recall_result().changed, 0);
  EXPECT_EQ(share_of(map, kBlind, is_even), 1.0);  // far from the rock nothing changes
}

TEST(TerrainMemory, TheGroundBehindAFallenRockStaysUnknownInLaterScans) {
  ScanningVehicle vehicle(kFirst);
  vehicle.scan(add_tunnel);
  vehicle.drive_to(kHere);
  vehicle.scan(kFallen);
  const TerrainMap map = vehicle.scan(kFallen, true);
  EXPECT_EQ(cell_at(map, 4.0, 0.0).ground, Ground::kNeverObserved);
  EXPECT_LE(share_of(map, kPlan, is_even), even_share_alone() + 1e-9);
}

TEST(TerrainMemory, ForgetsObstaclesThatHaveDisappeared) {
  ScanningVehicle vehicle(kFirst);
  vehicle.scan(tunnel_with_rock({4.0, 0.0, 0.3}, {0.6, 0.6, 0.6}));
  vehicle.drive_to(kHere);
  const TerrainMap map = vehicle.scan(add_tunnel);
  const Eigen::AlignedBox2d there(Eigen::Vector2d(3.5, -0.5), Eigen::Vector2d(5.5, 0.5));
  EXPECT_EQ(share_of(map, there, is_even), 1.0);
}

}  // namespace
}  // namespace adit
