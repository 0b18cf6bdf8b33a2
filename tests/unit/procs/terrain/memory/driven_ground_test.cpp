// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/terrain/memory/driven_ground.hpp"

#include <gtest/gtest.h>

#include "procs/terrain/memory/driven_path.hpp"
#include "tests/unit/procs/terrain/terrain_scenes.hpp"

namespace adit {
namespace {

TEST(DrivenPath, CountsTheDistanceWithoutNoise) {
  DrivenPath path(15.0, 0.5);
  std::int64_t utime = 1'600'000'000'000'000;
  for (int i = 0; i < 400; ++i) {
    EXPECT_TRUE(path.add(utime += 25'000, {0.02 * (i % 2), 0.0, 0.005 * (i % 3)}));
  }
  EXPECT_EQ(path.distance_travelled_m(), 0.0);
  for (int i = 0; i < 400; ++i) EXPECT_TRUE(path.add(utime += 125'000, {0.05 * i, 0.0, 0.0}));
  EXPECT_NEAR(path.distance_travelled_m(), 20.0, 0.2);  // one step, and the start
  EXPECT_GE(path.places().front().distance_travelled_m, path.distance_travelled_m() - 15.0);
  EXPECT_LE(path.places().size(), 151U);
}

TEST(DrivenPath, IsResetByAJumpOfOdom) {
  DrivenPath path(15.0, 0.5);
  EXPECT_TRUE(path.add(1'600'000'000'000'000, {}));
  EXPECT_FALSE(path.add(1'600'000'000'100'000, {3.0, 0.0, 0.0}));
  EXPECT_EQ(path.places().size(), 1U);
  EXPECT_FALSE(path.add(1'600'000'000'200'000, {3.0, 0.0, 1.5}));
  EXPECT_TRUE(path.add(1'600'000'010'000'000, {6.0, 0.0, 1.5}));  // ten seconds without poses
}

TEST(DrivenPath, IsResetByANewOdomFrame) {
  constexpr std::int64_t kOdomUtime = 1'600'000'001'000'000;
  DrivenPath path(15.0, 0.5);
  for (int i = 0; i < 20; ++i) path.add(kOdomUtime - 1'000'000 + 50'000 * i, {0.12 * i, 0.0, 0.0});
  EXPECT_TRUE(path.add(kOdomUtime, {2.28, 0.2, 0.0}));  // no jump
  ASSERT_EQ(path.places().size(), 21U);
  EXPECT_TRUE(path.reset(kOdomUtime));
  ASSERT_EQ(path.places().size(), 1U);  // the first one in the new odom frame
  EXPECT_FALSE(path.reset(kOdomUtime));
  path.anchor({0.0, 0.2, 0.0});
  ASSERT_EQ(path.places().size(), 21U);
  EXPECT_EQ(path.places().front().T_odom_body, (Pose2{0.0, 0.2, 0.0}));
}

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
