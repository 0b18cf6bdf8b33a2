// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/terrain/memory/driven_ground.hpp"

#include <gtest/gtest.h>

#include "tests/unit/procs/terrain/terrain_scenes.hpp"

namespace adit {
namespace {

TEST(DrivenGround, FillsTheTracksOfTheWheelsOnly) {
  ScanningVehicle vehicle({-5.0, 0.0, 0.0});
  vehicle.drive_to({0.0, 0.0, 0.0});
  const TerrainMap map = vehicle.scan(add_tunnel, true);
  for (double x = -1.85; x < 0.6; x += 0.1) {  // from where its own beams hit the ground
    for (const double side : {-1.0, 1.0}) {
      const TerrainCell& track = cell_at(map, x, side * 0.5);
      EXPECT_EQ(track.ground, Ground::kObserved) << x;
      EXPECT_NEAR(track.low_m, 0.0, 0.03);
    }
    EXPECT_EQ(cell_at(map, x, 0.0).ground, Ground::kNeverObserved) << x;
    EXPECT_EQ(cell_at(map, x, 0.9).ground, Ground::kNeverObserved) << x;
  }
}

TEST(DrivenGround, HasTheGradeOfTheGroundAround) {
  constexpr double kGrade = 0.25;
  const auto slope = [&](MeshBuilder& builder) {
    const auto corner = [&](float x, float y) {
      return builder.vertex({x, y, static_cast<float>(kGrade) * x});
    };
    builder.quad(corner(-15, -2), corner(15, -2), corner(15, 2), corner(-15, 2));
  };
  for (const bool rear : {false, true}) {
    ScanningVehicle vehicle({-1.0, 0.0, 0.0});
    vehicle.drive_to({0.0, 0.0, 0.0});
    const TerrainMap map = vehicle.scan(slope, rear);
    for (const double x : {-0.75, 0.75}) {  // the axles
      for (const double side : {-0.5, 0.5}) {
        const TerrainCell& track = cell_at(map, x, side);
        EXPECT_EQ(track.ground, Ground::kObserved) << rear;
        EXPECT_NEAR(track.low_m, kGrade * x, 0.05) << rear;  // without the grade 0.19
      }
    }
  }
}

TEST(DrivenGround, RemovesAnObstacleThatTheBodyDroveThrough) {
  const auto rock = [](MeshBuilder& builder) {
    add_tunnel(builder);
    add_rock(builder, {-2.0, 0.55, 0.4}, {0.3, 0.3, 0.8});
  };
  ScanningVehicle vehicle({-6.0, 0.0, 0.0});
  EXPECT_GT(cell_at(vehicle.scan(rock), 3.9, 0.55).coefficient_m, 0.5);
  vehicle.drive_to({0.0, 0.0, 0.0});  // it cannot exist
  const TerrainMap map = vehicle.scan(add_tunnel);
  for (const double x : {-2.1, -1.9}) {
    EXPECT_EQ(cell_at(map, x, 0.5).ground, Ground::kObserved);
    EXPECT_LT(cell_at(map, x, 0.5).coefficient_m, 0.05);
  }
}

}  // namespace
}  // namespace adit
