// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "procs/exploration/exploration.hpp"
#include "tests/support/robots/exploring_robot.hpp"
#include "tests/unit/procs/exploration/test_mines.hpp"

namespace adit {
namespace {

using Kind = CorridorNode::Kind;

/// The corridors of a completely explored mine.
CorridorGraph corridors_of(const test::PlanarMine& mine) {
  Exploration exploration{ExplorationParams{}};
  const auto run = test::run_exploration(mine, exploration, 2000.0);
  EXPECT_TRUE(run.complete);
  return exploration.corridors();
}

CorridorGraph corridors_of(const std::vector<Tunnel>& tunnels, double width_m = 3.0, int seed = 1) {
  return corridors_of(tunnel_mine(tunnels, width_m, seed));
}

/// Four walls of 0.2 m around p.
void add_post(const Eigen::Vector2d& p, std::vector<test::Segment>& walls) {
  test::add_closed(walls, {{p.x() - 0.1, p.y() - 0.1},
                           {p.x() + 0.1, p.y() - 0.1},
                           {p.x() + 0.1, p.y() + 0.1},
                           {p.x() - 0.1, p.y() + 0.1}});
}

/// A tunnel of 4 m by 40 m with rows of posts, a pair each 2 m.
test::PlanarMine timbered_tunnel(double right_m, double left_m) {
  std::vector<test::Segment> walls{
      {{-3, -2}, {37, -2}}, {{37, -2}, {37, 2}}, {{37, 2}, {-3, 2}}, {{-3, 2}, {-3, -2}}};
  for (double x = 2.0; x < 36.0; x += 2.0) {
    add_post({x, -right_m}, walls);
    add_post({x, left_m}, walls);
  }
  return test::planar_mine(std::move(walls), {});
}

std::vector<Eigen::Vector2d> places(const CorridorGraph& graph, Kind kind) {
  std::vector<Eigen::Vector2d> places;
  for (const CorridorNode& node : graph.nodes) {
    if (node.kind == kind) places.push_back(node.p_map);
  }
  return places;
}

/// In world; map begins at the start, 3 m along x.
void expect_place(const std::vector<Eigen::Vector2d>& places, double x, double y, double within) {
  const bool there = std::any_of(places.begin(), places.end(), [&](const Eigen::Vector2d& p) {
    return std::hypot(p.x() + 3.0 - x, p.y() - y) <= within;
  });
  EXPECT_TRUE(there) << "no node at " << x << ", " << y;
}

// Centre line of a rough corridor in cells of 0.2 m; a skeleton ends before the wall by about the
// radius of the vehicle, and as much may be lost in corners.
constexpr double kJunctionM = 1.0;
constexpr double kEndM = 2.0;

TEST(Corridors, HaveTheJunctionAndTheEndsOfATJunction) {
  const CorridorGraph graph = corridors_of(junction());
  ASSERT_EQ(places(graph, Kind::kJunction).size(), 1U);
  expect_place(places(graph, Kind::kJunction), 25, 0, kJunctionM);
  EXPECT_EQ(graph.corridors.size(), 3U);
  expect_place(places(graph, Kind::kDeadEnd), 25, -20, kEndM);
  expect_place(places(graph, Kind::kDeadEnd), 25, 20, kEndM);
}

TEST(Corridors, HaveTheLengthAndWidthOfTheTunnels) {
  const CorridorGraph graph = corridors_of(junction());
  // 22 m from the start, or from where the robot's rear would be, and twice 20 m.
  EXPECT_NEAR(graph.length_m(), 22.0 + 40.0, 2.0 * kEndM + 1.5);
  for (const Corridor& corridor : graph.corridors) EXPECT_NEAR(corridor.width_m, 3.0, 0.4);
}

/// Of timber along both walls, near them and far from them, and along one.
TEST(Corridors, AreAsWideAsTheRockBehindThePosts) {
  for (const auto& [right_m, left_m] : {std::pair(1.0, 1.0), {1.4, 1.2}, {0.6, 1.6}}) {
    const CorridorGraph graph = corridors_of(timbered_tunnel(right_m, left_m));
    EXPECT_GT(graph.length_m(), 20.0);
    for (const Corridor& corridor : graph.corridors) {
      if (corridor.length_m < 3.0) continue;  // between posts that the vehicle passes on both sides
      EXPECT_NEAR(corridor.width_m, 4.0, 0.3) << right_m << ", " << left_m;  // cells of 0.2 m
    }
  }
}

TEST(Corridors, MeetInOneJunctionAtACrossing) {
  const CorridorGraph graph = corridors_of(crossroads());
  ASSERT_EQ(places(graph, Kind::kJunction).size(), 1U);
  expect_place(places(graph, Kind::kJunction), 25, 0, kJunctionM);
  EXPECT_EQ(graph.corridors.size(), 4U);
}

TEST(Corridors, HaveNeitherJunctionsNorNichesInARoughStraightTunnel) {
  for (const int seed : {1, 2, 3}) {
    const CorridorGraph graph = corridors_of(straight(), 3.0, seed);
    EXPECT_TRUE(places(graph, Kind::kJunction).empty()) << seed;
    ASSERT_EQ(graph.corridors.size(), 1U) << seed;
    expect_place(places(graph, Kind::kDeadEnd), 40, 0, kEndM);
  }
}

TEST(Corridors, CloseALoop) {
  const CorridorGraph graph = corridors_of(ring());
  ASSERT_EQ(places(graph, Kind::kJunction).size(), 1U);
  expect_place(places(graph, Kind::kJunction), 10, 0, kJunctionM);
  EXPECT_EQ(graph.corridors.size(), 2U);
  EXPECT_NEAR(graph.length_m(), 7.0 + 80.0, 5.0);  // corners are rounded
}

TEST(Corridors, SurroundEachPillar) {
  const CorridorGraph graph = corridors_of(rooms_and_pillars());
  // Twelve crossings; the corners, of two corridors each, are not junctions.
  EXPECT_EQ(places(graph, Kind::kJunction).size(), 9U);
  const auto rings = static_cast<int>(graph.corridors.size()) -
                     static_cast<int>(graph.nodes.size()) +
                     1;  // Euler characteristic of a connected graph
  EXPECT_EQ(rings, 6);
}

}  // namespace
}  // namespace adit
