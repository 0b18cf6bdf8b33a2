// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "tests/unit/sim/world/props/prop_scene.hpp"

namespace adit {
namespace {

const Eigen::Vector3d kLeft = Eigen::Vector3d::UnitY();
const Eigen::Vector3d kAhead = Eigen::Vector3d::UnitX();
const Eigen::Vector3d kDown = -Eigen::Vector3d::UnitZ();

constexpr double kFloat = 1e-4;  // of single precision at 60 m, and of the ray casting

PropDescriptions with_rails(const std::string& tunnel) {
  PropDescriptions props;
  props.rails.push_back({.tunnel = tunnel, .from_m = 5.0, .to_m = 45.0, .gauge_m = 0.76});
  return props;
}

/// Across-coordinates at which a level line across the tunnel at x enters or leaves steel.
std::vector<double> crossings(const PropScene& scene, double x, double z) {
  std::vector<double> found;
  double y = -2.0;
  while (const auto range = scene.range({x, y, z}, kLeft)) {
    y += *range;
    found.push_back(y);
    y += 1e-3;
  }
  return found;
}

TEST(Rails, AreTwoHeadsAtTheGaugeEverywhere) {
  const PropScene scene(with_rails("main"));
  for (const double x : {5.01, 20.3, 44.99}) {
    const std::vector<double> faces = crossings(scene, x, 0.09);
    ASSERT_EQ(faces.size(), 4U) << x;  // two faces of each head
    EXPECT_NEAR(faces[1], -0.38, kFloat);
    EXPECT_NEAR(faces[2], 0.38, kFloat);
  }
  EXPECT_TRUE(crossings(scene, 4.9, 0.09).empty());
  EXPECT_TRUE(crossings(scene, 45.1, 0.09).empty());
}

TEST(Rails, HaveTheGivenHeightAboveTheReliefOfTheFloor) {
  const ReliefDescription relief{.height_m = 0.03, .length_m = 2.0};
  const PropScene scene(with_rails("bent"), relief);
  for (const Eigen::Vector3f& p : scene.world.mesh.vertices) {
    EXPECT_LE(p.z(), 0.1 + relief.height_m + kFloat);
  }
}

TEST(Rails, LieOnSleepersAtRegularDistances) {
  const PropScene scene(with_rails("main"));
  int sleepers = 0;
  bool on_one = false;
  for (double x = 5.0; x < 45.0; x += 0.05) {
    const auto down = scene.range({x, 0.0, 1.0}, kDown);
    if (down.has_value() && !on_one) ++sleepers;
    on_one = down.has_value();
    if (!down) continue;
    EXPECT_NEAR(1.0 - *down, 0.015, kFloat);
  }
  EXPECT_EQ(sleepers, 57);  // at 5.1 m and every 0.7 m up to 44.9 m
}

TEST(Rails, FollowABend) {
  const PropScene scene(with_rails("bent"));
  const TunnelLine& bent = scene.tunnels[1];
  for (const double s : {10.0, 29.0, 31.0, 40.0}) {
    const Eigen::Vector2d p = bent.beside(s, 0.4);
    const auto down = scene.range({p.x(), p.y(), 1.0}, kDown);
    ASSERT_TRUE(down.has_value()) << s;
    EXPECT_NEAR(1.0 - *down, 0.1, kFloat);
  }
}

TEST(Posts, StandFromFloorToRoofAndStopARay) {
  PropDescriptions props;
  props.posts.push_back({.tunnel = "main", .from_m = 10.0, .to_m = 22.0, .both_sides = true});
  const PropScene scene(props, {.height_m = 0.05, .length_m = 2.0});
  ASSERT_EQ(scene.world.truth.obstacles.size(), 10U);
  for (const Obstacle& post : scene.world.truth.obstacles) {
    EXPECT_EQ(post.kind, PartKind::kPost);
    Eigen::Vector2d middle(0.0, 0.0);
    for (const Eigen::Vector2d& p : post.outline) {
      middle += p / static_cast<double>(post.outline.size());
      EXPECT_LE(post.z_low_m, scene.heights.floor(p));
      EXPECT_GE(post.z_high_m, scene.heights.roof(p));
    }
    EXPECT_NEAR(std::abs(middle.y()), 1.2, 0.1);  // leans by at most 2 m · 0.03; random corners
    EXPECT_TRUE(scene.range({middle.x() - 1.0, middle.y(), 1.0}, kAhead).has_value());
  }
}

TEST(Posts, AreSingleWithoutARow) {
  PropDescriptions props;
  props.posts.push_back({.tunnel = "main", .from_m = 10.0});
  EXPECT_EQ(PropScene(props).world.truth.obstacles.size(), 1U);
}

TEST(Cribs, ReachFromFloorToRoof) {
  PropDescriptions props;
  props.cribs.push_back({.tunnel = "main", .at_m = 30.0, .across_m = -0.5});
  const PropScene scene(props);
  const Obstacle* crib = scene.obstacle("crib");
  ASSERT_NE(crib, nullptr);
  EXPECT_LE(crib->z_low_m, 0.0);
  EXPECT_GE(crib->z_high_m, 2.0);
  for (const double z : {0.03, 1.0, 1.95}) {  // timbers cross: rays from any side hit one
    EXPECT_TRUE(scene.range({28.0, -0.85, z}, kAhead).has_value()) << z;
  }
}

TEST(Rubble, IsAConeOfTheGivenHeightUnderACavity) {
  PropDescriptions props;
  props.rubble.push_back({.tunnel = "main", .at_m = 30.0, .radius_m = 1.5, .height_m = 0.8});
  const PropScene scene(props);
  const Obstacle* rubble = scene.obstacle("rubble");
  ASSERT_NE(rubble, nullptr);
  EXPECT_NEAR(rubble->z_high_m, 0.8, 0.32 + 0.1);  // a stone on top: 0.4 of the height; noise
  EXPECT_GE(rubble->z_high_m, 0.8);
  // Without bulking the cavity, twice a third of the cone's height, would hold the cone.
  EXPECT_NEAR(scene.heights.roof({30.0, 0.0}), 2.0 + 0.8 * 2.0 / 3.0 / 1.5, 1e-9);
  EXPECT_NEAR(scene.heights.roof({31.5, 0.0}), 2.0, 1e-9);
}

TEST(Cars, AreOpenOnTopAndHaveTheGivenSize) {
  PropDescriptions props;
  props.cars.push_back({.tunnel = "main", .at_m = 30.0});
  const PropScene scene(props);
  const Obstacle* car = scene.obstacle("car");
  ASSERT_NE(car, nullptr);
  EXPECT_NEAR(car->z_high_m, 0.9, kFloat);
  EXPECT_NEAR(car->z_low_m, 0.0, kFloat);
  EXPECT_NEAR(*scene.range({20.0, 0.0, 0.6}, kAhead), 10.0 - 1.1, kFloat);
  EXPECT_GT(*scene.range({30.0, 0.0, 2.0}, kDown), 2.0 - 0.4);  // the bottom, not a lid
}

TEST(Props, HaveUniqueNames) {
  PropDescriptions props = with_rails("main");
  props.posts.push_back({.tunnel = "main", .from_m = 10.0, .to_m = 22.0, .both_sides = true});
  props.posts.push_back({.tunnel = "bent", .from_m = 10.0, .to_m = 22.0});
  props.beams.push_back({.tunnel = "main", .at_m = 30.0, .cables = 3});
  const PropScene scene(props);
  std::set<std::string> names;
  for (const Part& part : scene.world.mesh.parts) names.insert(part.name);
  EXPECT_EQ(names.size(), scene.world.mesh.parts.size());
  for (const char* name : {"rails", "sleepers", "post_1", "post_15", "beam", "cable", "cable_3"}) {
    EXPECT_EQ(names.count(name), 1U) << name;
  }
}

TEST(Props, DoNotDependOnOtherProps) {
  PropDescriptions props;
  props.rubble.push_back({.tunnel = "main", .at_m = 30.0});
  const PropScene alone(props);
  props.rubble.push_back({.tunnel = "main", .at_m = 40.0});
  props.gas.push_back({.name = "gas", .tunnel = "main", .at_m = 5.0});
  const PropScene more(props);
  const auto& some = alone.world.mesh.vertices;
  ASSERT_LT(some.size(), more.world.mesh.vertices.size());
  EXPECT_TRUE(std::equal(some.begin(), some.end(), more.world.mesh.vertices.begin()));
}

}  // namespace
}  // namespace adit
