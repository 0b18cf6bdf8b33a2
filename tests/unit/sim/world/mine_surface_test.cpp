// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Surfaces built from a plan, tested with rays.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "sim/world/build_world.hpp"

namespace adit {
namespace {

constexpr float kFar = 500.0F;

PanelDescription panel() {
  PanelDescription panel;
  panel.name = "p";
  panel.T_world_panel = {3.0, -4.0, 0.3};
  panel.entries = 3;
  panel.crosscuts = 3;
  panel.length_m = 70.0;
  panel.slant_rad = 0.3;
  return panel;
}

WorldDescription panel_world() {
  WorldDescription description;
  description.plan.panels = {panel()};
  description.T_world_start = panel().T_world_panel * Pose2{2.0, 0.0, 0.0};
  return description;
}

/// A tunnel along x from 0, without relief anywhere.
WorldDescription smooth_tunnel(bool entrance = false) {
  WorldDescription description;
  description.plan.tunnels = {{"main", {0.0, 0.0, 30.0, 0.0}, 3.0, entrance}};
  description.heights.floor_relief.height_m = 0.0;
  description.heights.roof_relief.height_m = 0.0;
  description.wall_relief.height_m = 0.0;
  description.T_world_start = {5.0, 0.0, 0.0};
  return description;
}

std::optional<RayHit> cast(const Site& site, const Eigen::Vector3d& from,
                           const Eigen::Vector3d& towards) {
  return site.scene().cast({from.cast<float>(), towards.normalized().cast<float>()}, kFar);
}

/// A point on a centre line, between floor and roof.
Eigen::Vector3d inner_place(const World& world, std::mt19937_64& random) {
  const std::vector<TunnelEdge>& edges = world.truth.tunnels.edges;
  const TunnelEdge& edge =
      edges[std::uniform_int_distribution<std::size_t>(0, edges.size() - 1)(random)];
  const double share = std::uniform_real_distribution<double>(0.05, 0.95)(random);
  const Eigen::Vector2d p = edge.points[0] + share * (edge.points[1] - edge.points[0]);
  return {p.x(), p.y(), world.truth.floor_height(p).value() + 1.0};
}

Eigen::Vector3d any_direction(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  return Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
}

TEST(MineSurface, IsClosedAllAround) {
  const Site site(build_world(panel_world()));
  std::mt19937_64 random(1);
  int lost = 0;
  for (int i = 0; i < 20000; ++i) {
    lost += cast(site, inner_place(site.world(), random), any_direction(random)) ? 0 : 1;
  }
  EXPECT_EQ(lost, 0);
}

TEST(MineSurface, EveryEdgeBelongsToTwoTriangles) {
  const World world = build_world(panel_world());
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
  for (const TriangleMesh::Triangle& triangle : world.mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax(triangle[i], triangle[(i + 1) % 3]);
      balance[{low, high}] += triangle[i] == low ? 1 : -1;
    }
  }
  // Each traverses it in its own direction, so that all normals point into the open space.
  EXPECT_TRUE(std::all_of(balance.begin(), balance.end(),
                          [](const auto& edge) { return edge.second == 0; }));
}

TEST(MineSurface, WallsAreWhereThePlanHasThem) {
  const Site site(build_world(smooth_tunnel()));
  for (double x = 0.5; x < 30.0; x += 0.7) {
    const auto left = cast(site, {x, 0.3, 1.0}, Eigen::Vector3d::UnitY());
    const auto right = cast(site, {x, 0.3, 1.0}, -Eigen::Vector3d::UnitY());
    ASSERT_TRUE(left && right);
    // A point of the wall is kept a hundredth of an edge of the grid, 2 mm, from its corners.
    EXPECT_NEAR(left->distance_m, 1.2, 0.003);
    EXPECT_NEAR(right->distance_m, 1.8, 0.003);
  }
  EXPECT_NEAR(cast(site, {5.0, 0.0, 1.0}, Eigen::Vector3d::UnitX())->distance_m, 25.0, 0.003);
  EXPECT_NEAR(cast(site, {5.0, 0.0, 1.0}, -Eigen::Vector3d::UnitX())->distance_m, 5.0, 0.003);
}

TEST(MineSurface, FloorRoofAndWallsAreNamed) {
  const Site site(build_world(smooth_tunnel()));
  const auto part = [&](const Eigen::Vector3d& towards) {
    return site.world().mesh.part_of(cast(site, {5.0, 0.0, 1.0}, towards)->triangle);
  };
  EXPECT_EQ(part(-Eigen::Vector3d::UnitZ()).kind, PartKind::kFloor);
  EXPECT_EQ(part(Eigen::Vector3d::UnitZ()).kind, PartKind::kRoof);
  EXPECT_EQ(part(Eigen::Vector3d::UnitY()).kind, PartKind::kWall);
  EXPECT_EQ(part(Eigen::Vector3d::UnitY()).name, "walls");
}

TEST(MineSurface, FloorIsOfMudWhereItIsSoft) {
  WorldDescription description = smooth_tunnel();
  description.props.mud.push_back(
      {.name = "mud", .tunnel = "main", .at_m = 15.0, .across_m = 0.0, .radius_m = 1.2});
  const Site site(build_world(description));
  const auto part = [&](double x) {
    return site.world().mesh.part_of(cast(site, {x, 0.03, 1.0}, {0.0, 0.0, -1.0})->triangle);
  };
  EXPECT_EQ(part(15.0).kind, PartKind::kFloor);
  EXPECT_EQ(part(15.0).material, Material::kMud);
  EXPECT_EQ(part(15.0).name, "mud");
  // The centre of a triangle selects its owner: no vertex is farther from it than 0.2 m.
  EXPECT_EQ(part(15.0 + 1.2 - 0.2).material, Material::kMud);
  EXPECT_EQ(part(15.0 + 1.2 + 0.2).material, Material::kRock);
  EXPECT_EQ(part(15.0 - 1.2 - 0.2).material, Material::kRock);
}

TEST(MineSurface, RoughWallsKeepWithinTheirRelief) {
  WorldDescription description = smooth_tunnel();
  description.wall_relief.height_m = 0.2;
  const Site site(build_world(description));
  double least = 10.0;
  double most = 0.0;
  double change = 0.0;  // from one height to another
  for (double x = 1.0; x < 29.0; x += 0.1) {
    const double low = cast(site, {x, 0.0, 0.7}, Eigen::Vector3d::UnitY())->distance_m;
    const double high = cast(site, {x, 0.0, 1.4}, Eigen::Vector3d::UnitY())->distance_m;
    least = std::min({least, low, high});
    most = std::max({most, low, high});
    change = std::max(change, std::abs(high - low));
  }
  EXPECT_GE(least, 1.5 - 0.2 - 0.01);
  EXPECT_LE(most, 1.5 + 0.2 + 0.01);
  EXPECT_GT(most - least, 0.15);
  EXPECT_GT(change, 0.03);
}

TEST(MineSurface, FloorOfTheMeshIsTheFloorOfTheTruth) {
  WorldDescription description = panel_world();
  description.grid_m = 0.1;
  description.heights.profile_m = {0.0, 0.0, 40.0, 4.0};
  description.heights.floor_relief = {.height_m = 0.05, .length_m = 2.0, .octaves = 2};
  const Site site(build_world(description));
  std::mt19937_64 random(2);
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d p = inner_place(site.world(), random);
    const auto hit = cast(site, p, -Eigen::Vector3d::UnitZ());
    ASSERT_TRUE(hit);
    EXPECT_NEAR(p.z() - hit->distance_m, site.world().truth.floor_height(p.head<2>()).value(),
                0.01);  // curvature of the relief over one edge of the grid
  }
  EXPECT_FALSE(site.world().truth.floor_height({-50.0, 0.0}));
}

TEST(MineSurface, AnEntranceIsOpenAndHasGroundInFrontOfIt) {
  const Site site(build_world(smooth_tunnel(true)));
  EXPECT_FALSE(cast(site, {5.0, 0.0, 1.0}, -Eigen::Vector3d::UnitX()));
  EXPECT_TRUE(cast(site, {5.0, 0.0, 1.0}, Eigen::Vector3d::UnitX()));
  for (double x = -3.5; x < 0.0; x += 0.5) {
    const auto ground = cast(site, {x, 0.0, 1.0}, -Eigen::Vector3d::UnitZ());
    ASSERT_TRUE(ground);
    EXPECT_NEAR(ground->distance_m, 1.0, 1e-5);
    EXPECT_EQ(site.world().truth.floor_height({x, 0.0}), 0.0);
    EXPECT_FALSE(cast(site, {x, 0.0, 1.0}, Eigen::Vector3d::UnitY()));
  }
  EXPECT_FALSE(cast(site, {-0.5, 0.0, 1.0}, Eigen::Vector3d::UnitZ()));
  EXPECT_FALSE(cast(site, {-4.5, 0.0, 1.0}, -Eigen::Vector3d::UnitZ()));
}

TEST(MineSurface, RoughWallsLeaveNothingInAMouth) {
  WorldDescription description = smooth_tunnel(true);
  description.wall_relief = {.height_m = 0.4, .length_m = 0.5, .octaves = 2};
  for (description.seed = 1; description.seed < 6; ++description.seed) {
    const Site site(build_world(description));
    EXPECT_EQ(site.world().truth.plan.size(), 1U);
    for (double y = -1.0; y <= 1.0; y += 0.1) {
      EXPECT_FALSE(cast(site, {0.5, y, 1.0}, -Eigen::Vector3d::UnitX()));
      EXPECT_TRUE(site.world().truth.floor_height({0.0, y}));
    }
  }
}

TEST(MineSurface, OutlineOfAStraightTunnelIsItsRectangle) {
  for (const bool entrance : {false, true}) {
    const World world = build_world(smooth_tunnel(entrance));
    ASSERT_EQ(world.truth.plan.size(), 1U);
    // 2 mm along all walls, as above; the corners; and half a square of the grid at a mouth.
    EXPECT_NEAR(world.truth.plan[0].signed_area_m2(), 90.0, 0.2 + (entrance ? 0.1 * 3.0 : 0.0));
    EXPECT_FALSE(world.truth.plan[0].is_pillar());
  }
}

TEST(MineSurface, OutlinesOfAPanelGoAroundItAndItsPillars) {
  const World world = build_world(panel_world());
  const auto pillars = std::count_if(world.truth.plan.begin(), world.truth.plan.end(),
                                     [](const PlanRing& ring) { return ring.is_pillar(); });
  EXPECT_EQ(pillars, (3 - 1) * (3 - 1));
  EXPECT_EQ(world.truth.plan.size(), 5U);
  for (const PlanRing& ring : world.truth.plan) {
    if (!ring.is_pillar()) continue;
    // A parallelogram between middles, less half a width all around; walls are rough by 0.12 m.
    const double between = (12.0 - 3.0) * (20.0 - 3.0 / std::cos(0.3));
    EXPECT_NEAR(-ring.signed_area_m2(), between, 0.12 * 55.0);
  }
}

TEST(MineSurface, OutlineLiesOnTheWallAtItsHeight) {
  const Site site(build_world(panel_world()));
  const PlanRing& ring = site.world().truth.plan[0];
  for (std::size_t i = 2; i + 2 < ring.points.size(); i += 7) {
    const Eigen::Vector2d along = ring.points[i + 2] - ring.points[i - 2];
    const Eigen::Vector2d open = Eigen::Vector2d(-along.y(), along.x()).normalized();
    const Eigen::Vector2d p = ring.points[i] + 0.3 * open;
    const double z = site.world().truth.floor_height(p).value() + 0.6;
    const auto hit = cast(site, {p.x(), p.y(), z}, {-open.x(), -open.y(), 0.0});
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->distance_m, 0.3, 0.03);  // the wall leans, and the floor has relief
  }
}

TEST(MineSurface, PillarsStandInRooms) {
  WorldDescription description = smooth_tunnel();
  description.plan.tunnels.clear();
  description.plan.rooms = {{"room", {0.0, -5.0, 20.0, -5.0, 20.0, 5.0, 0.0, 5.0}}};
  description.plan.pillars = {{"pillar", {9.0, -1.0, 11.0, -1.0, 11.0, 1.0, 9.0, 1.0}}};
  const Site site(build_world(description));
  EXPECT_NEAR(cast(site, {5.0, 0.0, 1.0}, Eigen::Vector3d::UnitX())->distance_m, 4.0, 0.003);
  EXPECT_NEAR(cast(site, {5.0, 2.0, 1.0}, Eigen::Vector3d::UnitX())->distance_m, 15.0, 0.003);
  ASSERT_EQ(site.world().truth.plan.size(), 2U);
  EXPECT_TRUE(site.world().truth.tunnels.edges.empty());
}

TEST(MineSurface, TunnelsOpenIntoRoomsAndTunnelsThatTheyOnlyTouch) {
  WorldDescription description = smooth_tunnel();
  description.wall_relief = {.height_m = 0.4, .length_m = 0.5, .octaves = 2};
  description.plan.rooms = {{"room", {30.0, -5.0, 40.0, -5.0, 40.0, 5.0, 30.0, 5.0}}};
  description.plan.tunnels.push_back({"side", {15.0, 1.5, 15.0, 20.0}, 3.0, false});
  const Site site(build_world(description));
  EXPECT_EQ(site.world().truth.plan.size(), 1U);
  for (double across = -0.8; across <= 0.8; across += 0.1) {
    EXPECT_GT(cast(site, {5.0, across, 1.0}, Eigen::Vector3d::UnitX())->distance_m, 34.0);
    EXPECT_GT(cast(site, {15.0 + across, 0.0, 1.0}, Eigen::Vector3d::UnitY())->distance_m, 19.0);
  }
}

TEST(MineSurface, TheSameDescriptionGivesTheSameBytes) {
  const World a = build_world(panel_world());
  const World b = build_world(panel_world());
  ASSERT_EQ(a.mesh.vertices.size(), b.mesh.vertices.size());
  EXPECT_EQ(std::memcmp(a.mesh.vertices.data(), b.mesh.vertices.data(),
                        a.mesh.vertices.size() * sizeof(Eigen::Vector3f)),
            0);
  EXPECT_EQ(a.mesh.triangles, b.mesh.triangles);
  EXPECT_EQ(a.mesh.triangle_parts, b.mesh.triangle_parts);

  WorldDescription other = panel_world();
  other.seed = 2;
  EXPECT_NE(build_world(other).mesh.vertices, a.mesh.vertices);
}

}  // namespace
}  // namespace adit
