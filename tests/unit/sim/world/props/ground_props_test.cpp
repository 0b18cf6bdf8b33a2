// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include <gtest/gtest.h>

#include "tests/unit/sim/world/props/prop_scene.hpp"

namespace adit {
namespace {

const Eigen::Vector3d kDown = -Eigen::Vector3d::UnitZ();
const ReliefDescription kRelief{.height_m = 0.03, .length_m = 2.0};

TEST(Pits, HaveTheGivenDepthAndSteepSides) {
  PropDescriptions props;
  props.pits.push_back({.name = "sump", .tunnel = "main", .at_m = 30.0, .across_m = 0.5});
  const PropScene scene(props);
  EXPECT_EQ(scene.heights.floor({30.0, 0.5}), -1.0);
  EXPECT_EQ(scene.heights.floor({30.69, 0.5}), -1.0);
  EXPECT_EQ(scene.heights.floor({30.81, 0.5}), 0.0);
  EXPECT_NEAR(scene.heights.floor({30.75, 0.5}), -0.5, 1e-9);  // in the middle of its side of 0.1 m
  const Obstacle* pit = scene.obstacle("sump");
  ASSERT_NE(pit, nullptr);
  EXPECT_EQ(pit->kind, PartKind::kFloor);
  EXPECT_EQ(pit->z_low_m, -1.0);
  for (const Eigen::Vector2d& corner : pit->outline) {
    EXPECT_GE((corner - Eigen::Vector2d(30.0, 0.5)).norm(), 0.8);
  }
}

TEST(LowRoofs, LeaveTheClearanceAboveTheReliefOfTheFloor) {
  PropDescriptions props;
  props.low_roofs.push_back(
      {.name = "squeeze", .tunnel = "bent", .from_m = 20.0, .to_m = 40.0, .clearance_m = 0.8});
  const PropScene scene(props, kRelief);
  const TunnelLine& bent = scene.tunnels[1];
  for (double s = 20.0; s < 40.0; s += 0.31) {
    const Eigen::Vector2d p = bent.beside(s, 0.9);
    EXPECT_NEAR(scene.heights.roof(p) - scene.heights.floor(p), 0.8, 1e-9);
  }
  for (const double s : {10.0, 19.9, 40.1}) {
    EXPECT_GT(scene.heights.roof(bent.beside(s, 0.0)), 1.8) << s;
  }
  const Obstacle* low = scene.obstacle("squeeze");
  ASSERT_NE(low, nullptr);
  EXPECT_EQ(low->kind, PartKind::kRoof);
  EXPECT_NEAR(low->z_low_m, 0.8, kRelief.height_m);
}

PropDescriptions with_water(bool mirror) {
  PropDescriptions props;
  props.water.push_back({.name = "pool",
                         .tunnel = "main",
                         .from_m = 20.0,
                         .to_m = 40.0,
                         .depth_m = 0.5,
                         .mirror = mirror});
  return props;
}

TEST(StandingWater, IsLevelAndHasTheGivenDepth) {
  const PropScene scene(with_water(false), kRelief);
  ASSERT_EQ(scene.world.water.size(), 1U);
  const double level = scene.world.water[0].level_m;
  EXPECT_EQ(level, std::min(scene.heights.floor({20.0, 0.0}), scene.heights.floor({40.0, 0.0})));
  for (const double y : {-1.9, 0.0, 1.9}) {
    EXPECT_NEAR(scene.heights.floor({30.0, y}), level - 0.5, 1e-9);
    EXPECT_NEAR(*scene.range({25.0, y, 1.0}, kDown), 1.0 - level, 1e-5);
  }
}

TEST(StandingWater, IsSolidForLasersOnly) {
  for (const bool mirror : {false, true}) {
    const PropScene scene(with_water(mirror));
    EXPECT_TRUE(scene.range({30.0, 0.0, 1.0}, kDown).has_value());
    EXPECT_FALSE(scene.range({30.0, 0.0, 1.0}, kDown, RayScene::Layer::kSolid).has_value());
    EXPECT_EQ(scene.world.mesh.parts[0].material, mirror ? Material::kMirror : Material::kWater);
  }
}

TEST(StandingWater, ReachesFromWallToWall) {
  const PropScene scene(with_water(false));
  for (const double y : {-2.0, 2.0}) {
    EXPECT_TRUE(scene.range({20.1, y, 1.0}, kDown).has_value());
    EXPECT_TRUE(scene.range({39.9, y, 1.0}, kDown).has_value());
  }
  EXPECT_FALSE(scene.range({19.9, 0.0, 1.0}, kDown).has_value());
}

TEST(Mud, IsSoftGroundAndAnObstacle) {
  PropDescriptions props;
  props.mud.push_back({.name = "mud", .tunnel = "main", .at_m = 30.0, .across_m = 1.0});
  const PropScene scene(props);
  ASSERT_EQ(scene.world.soft_ground.size(), 1U);
  EXPECT_EQ(scene.world.soft_ground[0].p_world, Eigen::Vector2d(30.0, 1.0));
  ASSERT_NE(scene.obstacle("mud"), nullptr);
  EXPECT_NEAR(scene.obstacle("mud")->z_low_m, -0.15, 1e-12);
}

TEST(Gas, IsAtItsPosition) {
  PropDescriptions props;
  props.gas.push_back({.name = "gas", .tunnel = "bent", .at_m = 10.0});
  const PropScene scene(props);
  ASSERT_EQ(scene.world.gas.size(), 1U);
  EXPECT_EQ(scene.world.gas[0].p_world, Eigen::Vector2d(10.0, 20.0));
}

}  // namespace
}  // namespace adit
