// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/terrain/driven_ground.hpp"

#include <gtest/gtest.h>

#include "procs/terrain/driven_way.hpp"
#include "tests/unit/procs/terrain/memory_scenes.hpp"
#include "tests/unit/procs/terrain/terrain_scenes.hpp"

namespace adit {
namespace {

TEST(DrivenWay, CountsWhatIsDrivenAndNoNoise) {
  DrivenWay way(15.0, 0.5);
  std::int64_t utime = 1'600'000'000'000'000;
  for (int i = 0; i < 400; ++i) {
    EXPECT_TRUE(way.add(utime += 25'000, {0.02 * (i % 2), 0.0, 0.005 * (i % 3)}));
  }
  EXPECT_EQ(way.way_m(), 0.0);
  for (int i = 0; i < 400; ++i) EXPECT_TRUE(way.add(utime += 125'000, {0.05 * i, 0.0, 0.0}));
  EXPECT_NEAR(way.way_m(), 20.0, 0.2);  // a piece, and where it began
  EXPECT_GE(way.places().front().way_m, way.way_m() - 15.0);
  EXPECT_LE(way.places().size(), 151U);
}

TEST(DrivenWay, BeginsAnewWhereOdomJumps) {
  DrivenWay way(15.0, 0.5);
  EXPECT_TRUE(way.add(1'600'000'000'000'000, {}));
  EXPECT_FALSE(way.add(1'600'000'000'100'000, {3.0, 0.0, 0.0}));
  EXPECT_EQ(way.places().size(), 1U);
  EXPECT_FALSE(way.add(1'600'000'000'200'000, {3.0, 0.0, 1.5}));
  EXPECT_TRUE(way.add(1'600'000'010'000'000, {6.0, 0.0, 1.5}));  // in ten seconds without poses
}

TEST(DrivenWay, BeginsAnewWhereItIsSaidThatOdomDoes) {
  constexpr std::int64_t kOdomUtime = 1'600'000'001'000'000;
  DrivenWay way(15.0, 0.5);
  for (int i = 0; i < 20; ++i) way.add(kOdomUtime - 1'000'000 + 50'000 * i, {0.12 * i, 0.0, 0.0});
  EXPECT_TRUE(way.add(kOdomUtime, {2.28, 0.2, 0.0}));  // no jump
  ASSERT_EQ(way.places().size(), 21U);
  EXPECT_TRUE(way.begin_anew(kOdomUtime));
  ASSERT_EQ(way.places().size(), 1U);  // the first of the new odom
  EXPECT_FALSE(way.begin_anew(kOdomUtime));
  way.tie({0.0, 0.2, 0.0});
  ASSERT_EQ(way.places().size(), 21U);
  EXPECT_EQ(way.places().front().T_odom_body, (Pose2{0.0, 0.2, 0.0}));
}

TEST(DrivenGround, CarriedTheWheelsAndSaysNothingOfWhatIsBetween) {
  LookingVehicle vehicle({-5.0, 0.0, 0.0});
  vehicle.drive_to({0.0, 0.0, 0.0});
  const TerrainMap map = vehicle.look(add_drift, true);
  for (double x = -1.85; x < 0.6; x += 0.1) {  // from where its own beams meet the ground
    for (const double side : {-1.0, 1.0}) {
      const TerrainCell& track = cell_at(map, x, side * 0.5);
      EXPECT_EQ(track.ground, Ground::kSeen) << x;
      EXPECT_NEAR(track.low_m, 0.0, 0.03);
    }
    EXPECT_EQ(cell_at(map, x, 0.0).ground, Ground::kNeverSeen) << x;
    EXPECT_EQ(cell_at(map, x, 0.9).ground, Ground::kNeverSeen) << x;
  }
}

TEST(DrivenGround, TakesBackAnObstacleThatTheBodyCameThrough) {
  const auto rock = [](MeshBuilder& builder) {
    add_drift(builder);
    add_rock(builder, {-2.0, 0.55, 0.4}, {0.3, 0.3, 0.8});
  };
  LookingVehicle vehicle({-6.0, 0.0, 0.0});
  EXPECT_GT(cell_at(vehicle.look(rock), 3.9, 0.55).coefficient_m, 0.5);
  vehicle.drive_to({0.0, 0.0, 0.0});  // it was not there, or it would have been met
  const TerrainMap map = vehicle.look(add_drift);
  for (const double x : {-2.1, -1.9}) {
    EXPECT_EQ(cell_at(map, x, 0.5).ground, Ground::kSeen);
    EXPECT_LT(cell_at(map, x, 0.5).coefficient_m, 0.05);
  }
}

}  // namespace
}  // namespace adit
