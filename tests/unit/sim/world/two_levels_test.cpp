// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/random/two_levels.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <stdexcept>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/vehicle/stance.hpp"
#include "sim/world/build_world.hpp"
#include "sim/world/plan/tunnel_line.hpp"
#include "sim/world/world_file.hpp"
#include "tests/support/reachable_area.hpp"

namespace adit {
namespace {

using testing::HasSubstr;

constexpr int kSeeds = 50;
const Eigen::Vector3f kUpward = Eigen::Vector3f::UnitZ();

std::vector<TunnelLine> lines_of(const WorldDescription& description) {
  return tunnel_lines(description.plan);
}

TEST(TwoLevels, DependOnTheirSeed) {
  std::set<std::string> all;
  for (int seed = 0; seed < kSeeds; ++seed) {
    const std::string text = to_world_file(two_levels(seed));
    EXPECT_EQ(to_world_file(find_world("two_levels", seed)), text);
    all.insert(text);
  }
  EXPECT_EQ(all.size(), static_cast<std::size_t>(kSeeds));
}

TEST(TwoLevels, AreOneClosedSurfaceButForTheEntrance) {
  for (int seed = 0; seed < kSeeds; seed += 5) {
    const World world = build_world(two_levels(seed));
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (const auto& triangle : world.mesh.triangles) {
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_TRUE(edges.insert({triangle[i], triangle[(i + 1) % 3]}).second) << seed;
      }
    }
    for (const auto& [from, to] : edges) {
      if (edges.contains({to, from})) continue;
      EXPECT_LT(world.mesh.vertices[from].x(), 0.3F) << seed;  // the apron
    }
  }
}

/// A place where two tunnels cross above each other.
struct Crossing {
  std::string upper;
  std::string lower;
  Eigen::Vector2d p_world;
};

std::vector<Crossing> crossings_of(const WorldDescription& description) {
  constexpr double kStep = 0.5;
  std::vector<Crossing> crossings;
  const std::vector<TunnelLine> tunnels = lines_of(description);
  for (const TunnelLine& upper : tunnels) {
    for (const TunnelLine& lower : tunnels) {
      if (upper.level != 0 || lower.level != 2) continue;
      for (double s_m = 0.0; s_m < lower.length_m(); s_m += kStep) {
        const Eigen::Vector2d p = lower.at(s_m).p_world;
        if (upper.distance_m(p) < kStep) crossings.push_back({upper.name, lower.name, p});
      }
    }
  }
  return crossings;
}

TEST(TwoLevels, HaveTwoMetresOfRockBetweenThemByRays) {
  for (int seed = 0; seed < kSeeds; ++seed) {
    WorldDescription description = two_levels(seed);
    const Site site(build_world(description));
    const auto crossings = crossings_of(description);
    const auto of_ramp = [](const Crossing& c) {
      return c.upper == "ramp_top" && c.lower == "ramp_foot";
    };
    EXPECT_TRUE(std::any_of(crossings.begin(), crossings.end(), of_ramp)) << seed;
    int checked = 0;
    for (const Crossing& crossing : crossings) {
      const Eigen::Vector2d& p = crossing.p_world;
      const auto upper_floor_m = site.world().truth.floor_at(p, 0);
      const auto lower_floor_m = site.world().truth.floor_at(p, 2);
      if (!upper_floor_m || !lower_floor_m) continue;  // beside the end of one
      const Eigen::Vector3f in_upper(static_cast<float>(p.x()), static_cast<float>(p.y()),
                                     static_cast<float>(*upper_floor_m) + 1.0F);
      const Eigen::Vector3f in_lower(static_cast<float>(p.x()), static_cast<float>(p.y()),
                                     static_cast<float>(*lower_floor_m) + 1.0F);
      const auto floor = site.scene().cast({in_upper, -kUpward}, 5.0F);
      const auto lower_floor = site.scene().cast({in_lower, -kUpward}, 5.0F);
      const auto roof = site.scene().cast({in_lower, kUpward}, 5.0F);
      ASSERT_TRUE(floor && lower_floor && roof) << seed;
      EXPECT_NEAR(floor->distance_m, 1.0, 0.02) << seed;  // between the vertices of the mesh
      EXPECT_NEAR(lower_floor->distance_m, 1.0, 0.02) << seed;
      const double rock_m = (in_upper.z() - floor->distance_m) - (in_lower.z() + roof->distance_m);
      EXPECT_GT(rock_m, 2.0) << seed << " " << crossing.upper << " above " << crossing.lower;
      ++checked;
    }
    EXPECT_GE(checked, 4) << seed;  // two crossings, in steps of half a metre
  }
}

TEST(TwoLevels, TunnelGraphsJoinThemByTheRampOnly) {
  for (int seed = 0; seed < kSeeds; ++seed) {
    WorldDescription description = two_levels(seed);
    description.grid_m = 1.0;
    const TunnelGraph graph = build_world(description).truth.tunnels;
    // A tree: one edge fewer than nodes, and all nodes connected.
    EXPECT_EQ(graph.edges.size() + 1, graph.nodes.size()) << seed;
    std::vector<int> part(graph.nodes.size());
    for (std::size_t i = 0; i < part.size(); ++i) part[i] = static_cast<int>(i);
    for (std::size_t round = 0; round < part.size(); ++round) {
      for (const TunnelEdge& edge : graph.edges) {
        auto& from = part[static_cast<std::size_t>(edge.from)];
        auto& to = part[static_cast<std::size_t>(edge.to)];
        from = to = std::min(from, to);
      }
    }
    EXPECT_EQ(std::count(part.begin(), part.end(), 0), std::ssize(part)) << seed;
  }
}

bool reaches_level(const ReachableArea& area, int level) {
  return std::find(area.levels.begin(), area.levels.end(), level) != area.levels.end();
}

TEST(TwoLevels, AreReachedThroughTheRampOnly) {
  for (int seed = 0; seed < kSeeds; seed += 7) {
    const World world = build_world(two_levels(seed));
    const ReachableArea area = reachable_area(world, {});
    ASSERT_EQ(area.edge_length_m.size(), world.truth.tunnels.edges.size());
    for (std::size_t i = 0; i < area.edge_length_m.size(); ++i) {
      const TunnelEdge& edge = world.truth.tunnels.edges[i];
      // The centre of the vehicle stays half a length from a dead end.
      EXPECT_GT(area.edge_length_m[i], edge.length_m - 2.0) << seed << " " << edge.tunnel;
    }
    World closed = world;
    const Eigen::Vector2d p = lines_of(two_levels(seed))[2].at(20.0).p_world;
    closed.truth.obstacles.push_back({.kind = PartKind::kCrib,
                                      .name = "wall",
                                      .outline = {{p.x() - 3.0, p.y() - 3.0},
                                                  {p.x() + 3.0, p.y() - 3.0},
                                                  {p.x() + 3.0, p.y() + 3.0},
                                                  {p.x() - 3.0, p.y() + 3.0}},
                                      .z_low_m = -20.0,
                                      .z_high_m = 20.0,
                                      .level = 1});
    const ReachableArea upper = reachable_area(closed, {});
    EXPECT_TRUE(reaches_level(upper, 0)) << seed;
    EXPECT_FALSE(reaches_level(upper, 2)) << seed;
  }
}

TEST(TwoLevels, AreDrivenFromTheEntranceToTheLowerLevelAndBelowItself) {
  for (int seed = 0; seed < kSeeds; seed += 3) {
    const WorldDescription description = two_levels(seed);
    const Site site(build_world(description));
    Stance stance(site, {});
    const Pose2& start = description.T_world_start;
    ASSERT_EQ(stance.put(start, site.world().truth.floor_at(start.translation(), 0).value()),
              std::nullopt);
    double low_m = 0.0;
    for (const char* name : {"main", "ramp_top", "ramp", "ramp_foot"}) {
      const TunnelLine line = find_tunnel(lines_of(description), name, "the test");
      for (double s_m = line.entrance ? 3.0 : 0.0; s_m < line.length_m() - 1.5; s_m += 0.05) {
        const TunnelLine::Station at = line.at(s_m);
        ASSERT_EQ(stance.move({at.p_world.x(), at.p_world.y(), at.heading_rad}), std::nullopt)
            << seed << " " << name << " " << s_m;
        const double pitch = std::asin(stance.T_world_body().linear()(2, 0));
        EXPECT_LT(std::abs(std::tan(pitch)), 0.36) << seed << " " << name << " " << s_m;
        low_m = std::min(low_m, stance.T_world_body().translation().z());
      }
      if (line.level == 2) break;
    }
    const Eigen::Vector3d p_world = stance.T_world_body().translation();
    EXPECT_EQ(site.world().truth.level_at(p_world), 2) << seed;
    EXPECT_LT(low_m, -2.0) << seed;
  }
}

TEST(TwoLevels, FloorsAreContinuousAtTheJoints) {
  for (int seed = 0; seed < kSeeds; ++seed) {
    WorldDescription description = two_levels(seed);
    description.grid_m = 1.0;
    const World world = build_world(description);
    const TunnelLine ramp = lines_of(description)[2];
    ASSERT_EQ(ramp.name, "ramp");
    for (const auto& [s_m, level] : {std::pair(0.0, 0), std::pair(ramp.length_m(), 2)}) {
      for (const double across_m : {-1.2, 0.0, 1.2}) {
        const Eigen::Vector2d p = ramp.beside(s_m, across_m);
        EXPECT_NEAR(world.truth.floor_at(p, level).value(), world.truth.floor_at(p, 1).value(),
                    1e-9)
            << seed;
      }
    }
  }
}

/// Two tunnels in line along x that meet at 20 m, on levels 0 and 1.
WorldDescription joined() {
  WorldDescription description;
  description.plan.tunnels = {{"a", {0.0, 0.0, 20.0, 0.0}, 3.0, true},
                              {"b", {20.0, 0.0, 40.0, 0.0}, 3.0, false}};
  description.plan.tunnels[1].level = 1;
  description.T_world_start = {3.0, 0.0, 0.0};
  return description;
}

std::string error_of_building(const WorldDescription& description) {
  try {
    build_world(description);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Levels, ATunnelInTwoPartsIsThatOfOne) {
  WorldDescription one = joined();
  one.plan.tunnels = {{"a", {0.0, 0.0, 40.0, 0.0}, 3.0, true}};
  const Site in_parts(build_world(joined()));
  const Site whole(build_world(one));
  EXPECT_EQ(in_parts.world().mesh.triangles.size(), whole.world().mesh.triangles.size());
  EXPECT_EQ(in_parts.world().mesh.vertices.size(), whole.world().mesh.vertices.size());
  for (double angle = 0.0; angle < 6.28; angle += 0.01) {
    const Ray ray{{19.0F, 0.2F, 1.0F},
                  Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.3 * std::sin(3.0 * angle))
                      .cast<float>()
                      .normalized()};
    const auto a = in_parts.scene().cast(ray, 50.0F);
    const auto b = whole.scene().cast(ray, 50.0F);
    ASSERT_EQ(a.has_value(), b.has_value()) << angle;
    if (!a) continue;
    EXPECT_NEAR(a->distance_m, b->distance_m, 1e-4) << angle;  // single precision
  }
}

TEST(Levels, RejectTunnelsThatDoNotFit) {
  WorldDescription description = joined();
  EXPECT_EQ(error_of_building(description), "");
  description.plan.tunnels[1].width_m = 3.5;
  EXPECT_THAT(error_of_building(description), HasSubstr("not the same width"));
  description = joined();
  description.plan.tunnels[1].points_m = {20.0, 0.0, 40.0, 5.0};
  EXPECT_THAT(error_of_building(description), HasSubstr("at an angle"));
  description = joined();
  description.plan.tunnels[1].points_m = {20.0, 0.0, 22.0, 0.0};
  EXPECT_THAT(error_of_building(description), HasSubstr("not straight for 4.5 m"));
  description = joined();
  description.plan.tunnels.push_back({"c", {18.0, -9.0, 18.0, 9.0}, 3.0, false});
  EXPECT_THAT(error_of_building(description), HasSubstr("'c' is too close to the joint"));
  description = joined();
  description.start_level = 7;
  EXPECT_THAT(error_of_building(description), HasSubstr("no tunnel is on that level"));
  description = joined();
  description.props.mud.push_back({.name = "mud", .tunnel = "a", .at_m = 10.0});
  EXPECT_THAT(error_of_building(description), HasSubstr("one level"));
}

}  // namespace
}  // namespace adit
