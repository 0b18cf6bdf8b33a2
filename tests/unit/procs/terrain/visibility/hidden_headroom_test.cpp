// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Ground that is seen below something that hides what is above it.
#include <cmath>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

#include "procs/terrain/terrain.hpp"
#include "tests/unit/procs/terrain/terrain_scenes.hpp"

namespace adit {
namespace {

TerrainMap terrain_of(const std::function<void(MeshBuilder&)>& add) {
  return Terrain({}).make(cloud_of(add));
}

bool hides_headroom(const TerrainCell& cell) {
  return cell.ground == Ground::kObserved && std::isnan(cell.clearance_m);
}

bool seems_open(const TerrainCell& cell) {
  return cell.ground == Ground::kObserved && std::isinf(cell.clearance_m);
}

/// A slab over the right half of a tunnel, from x = 6 m on.
TerrainMap below_slab(double underside_m) {
  return terrain_of([&](MeshBuilder& builder) {
    add_tunnel(builder);
    add_rock(builder, {8.0, -1.0, underside_m + 0.6}, {4.0, 2.0, 1.2});
  });
}

/// Half a metre behind the face, and left of the far side, which nothing hides.
const Eigen::AlignedBox2d kBelow(Eigen::Vector2d(6.6, -1.4), Eigen::Vector2d(9.0, -0.5));

TEST(HiddenHeadroom, IsThatBehindTheLipOfALowRoof) {
  const TerrainMap map = below_slab(0.8);
  EXPECT_GT(share_of(map, kBelow, hides_headroom), 0.3);
  EXPECT_EQ(share_of(map, kBelow, seems_open), 0.0);
}

TEST(HiddenHeadroom, IsNoneBelowARoofUnderWhichTheVehicleFits) {
  const TerrainMap map = below_slab(1.25);
  EXPECT_EQ(share_of(map, kBelow, hides_headroom), 0.0);
}

TEST(HiddenHeadroom, IsNoneInAnOpenTunnelOrBehindARock) {
  const Eigen::AlignedBox2d ahead(Eigen::Vector2d(2.0, -1.5), Eigen::Vector2d(12.0, 1.5));
  EXPECT_EQ(share_of(terrain_of(add_tunnel), ahead, hides_headroom), 0.0);
  const TerrainMap with_rock = terrain_of([](MeshBuilder& builder) {
    add_tunnel(builder);
    add_rock(builder, {5.0, 0.0, 0.25}, {1.0, 1.0, 0.5});
  });
  EXPECT_EQ(share_of(with_rock, ahead, hides_headroom), 0.0);
}

/// In a sector that meets its edge the highest beams may end at a pillar and lower ones pass it.
TEST(HiddenHeadroom, IsNoneBesideAPillar) {
  for (int degrees = 40; degrees <= 70; degrees += 2) {
    const double angle_rad = degrees * std::numbers::pi / 180.0;
    const Eigen::Vector2d pillar = 2.2 * Eigen::Vector2d(std::cos(angle_rad), std::sin(angle_rad));
    const TerrainMap map = terrain_of([&](MeshBuilder& builder) {
      add_rock(builder, {0.0, 0.0, -0.5}, {30.0, 30.0, 1.0});
      add_rock(builder, {0.0, 0.0, 2.5}, {30.0, 30.0, 1.0});
      add_rock(builder, {1.0 + pillar.x(), pillar.y(), 1.0}, {0.4, 0.4, 3.0});
    });
    const Eigen::AlignedBox2d behind(Eigen::Vector2d(1.5, pillar.y() + 0.5),
                                     Eigen::Vector2d(6.0, 6.0));
    EXPECT_EQ(share_of(map, behind, hides_headroom), 0.0) << degrees;
  }
}

TEST(HiddenHeadroom, EndsWhereTheVehicleHasBeen) {
  const auto build = [](MeshBuilder& builder) {
    add_tunnel(builder);
    add_rock(builder, {8.0, -1.0, 1.4}, {4.0, 2.0, 1.2});
  };
  ScanningVehicle vehicle(Pose2{});
  EXPECT_GT(share_of(vehicle.scan(build), kBelow, hides_headroom), 0.3);
  vehicle.drive_to({8.0, -1.0, 0.0});
  const TerrainMap map = vehicle.scan(build, true);  // with the rear laser
  const Eigen::AlignedBox2d passed(Eigen::Vector2d(-1.0, -0.3), Eigen::Vector2d(0.0, 0.3));
  EXPECT_EQ(share_of(map, passed, hides_headroom), 0.0);
}

}  // namespace
}  // namespace adit
