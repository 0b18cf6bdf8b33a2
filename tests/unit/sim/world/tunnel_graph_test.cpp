// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/plan/tunnel_graph.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace adit {
namespace {

TunnelLine line(const std::string& name, std::vector<Eigen::Vector2d> points) {
  return {name, std::move(points), 3.0, false};
}

int degree(const TunnelGraph& graph, std::size_t node) {
  int count = 0;
  for (const TunnelEdge& edge : graph.edges) {
    count += edge.from == static_cast<int>(node) ? 1 : 0;
    count += edge.to == static_cast<int>(node) ? 1 : 0;
  }
  return count;
}

int nodes_of_degree(const TunnelGraph& graph, int requested) {
  int count = 0;
  for (std::size_t i = 0; i < graph.nodes.size(); ++i)
    count += degree(graph, i) == requested ? 1 : 0;
  return count;
}

TEST(TunnelGraph, ACrossHasFourArms) {
  const TunnelGraph graph =
      tunnel_graph({line("a", {{0.0, 0.0}, {20.0, 0.0}}), line("b", {{5.0, -8.0}, {5.0, 12.0}})});
  EXPECT_EQ(graph.nodes.size(), 5U);
  ASSERT_EQ(graph.edges.size(), 4U);
  EXPECT_DOUBLE_EQ(graph.edges[0].length_m, 5.0);
  EXPECT_DOUBLE_EQ(graph.edges[1].length_m, 15.0);
  EXPECT_DOUBLE_EQ(graph.edges[2].length_m, 8.0);
  EXPECT_DOUBLE_EQ(graph.edges[3].length_m, 12.0);
  EXPECT_EQ(graph.edges[3].tunnel, "b");
  EXPECT_EQ(nodes_of_degree(graph, 4), 1);
}

TEST(TunnelGraph, EdgesRunFromNodeToNode) {
  const TunnelGraph graph = tunnel_graph(
      {line("a", {{0.0, 0.0}, {10.0, 0.0}, {10.0, 10.0}}), line("b", {{4.0, 0.3}, {4.0, 12.0}})});
  for (const TunnelEdge& edge : graph.edges) {
    EXPECT_EQ(edge.points.front(), graph.nodes[static_cast<std::size_t>(edge.from)].p_world);
    EXPECT_EQ(edge.points.back(), graph.nodes[static_cast<std::size_t>(edge.to)].p_world);
  }
  EXPECT_EQ(graph.edges.size(), 3U);
  EXPECT_NEAR(graph.length_m(), 20.0 + 12.0, 1e-9);
}

TEST(TunnelGraph, ATunnelThatEndsAtTheWallOfAnotherIsExtendedToItsCentreLine) {
  const TunnelGraph graph =
      tunnel_graph({line("a", {{0.0, 0.0}, {20.0, 0.0}}), line("b", {{8.0, 1.5}, {8.0, 11.5}})});
  EXPECT_EQ(graph.nodes.size(), 4U);
  ASSERT_EQ(graph.edges.size(), 3U);
  EXPECT_DOUBLE_EQ(graph.edges[2].length_m, 11.5);
}

TEST(TunnelGraph, OneThatEndsBehindTheCentreLineOfAnotherMeetsItThere) {
  const TunnelGraph graph =
      tunnel_graph({line("a", {{0.0, 0.0}, {20.0, 0.0}}), line("b", {{8.0, -1.2}, {8.0, 11.5}})});
  EXPECT_EQ(graph.nodes.size(), 4U);
  EXPECT_EQ(graph.edges.size(), 3U);
  EXPECT_NEAR(graph.length_m(), 20.0 + 11.5, 1e-9);
}

TEST(TunnelGraph, OneThatEndsInRockMeetsNothing) {
  const TunnelGraph graph =
      tunnel_graph({line("a", {{0.0, 0.0}, {20.0, 0.0}}), line("b", {{8.0, 4.0}, {8.0, 11.5}})});
  EXPECT_EQ(graph.nodes.size(), 4U);
  EXPECT_EQ(graph.edges.size(), 2U);
}

TEST(TunnelGraph, APanelIsAGrid) {
  PlanDescription plan;
  plan.panels = {{}};
  PanelDescription& panel = plan.panels[0];
  panel.name = "panel";
  panel.entries = 2;
  panel.crosscuts = 3;
  panel.slant_rad = 0.2;
  panel.T_world_panel = {7.0, 3.0, 1.0};
  const TunnelGraph graph = tunnel_graph(tunnel_lines(plan));
  EXPECT_EQ(graph.nodes.size(), 2U * 3U + 4U);
  EXPECT_EQ(graph.edges.size(), 2U * 4U + 3U);
  EXPECT_NEAR(graph.length_m(), 2.0 * 60.0 + 3.0 * 12.0 / std::cos(0.2), 1e-9);
  EXPECT_EQ(nodes_of_degree(graph, 3), 6);
  EXPECT_EQ(nodes_of_degree(graph, 1), 4);
}

TEST(TunnelGraph, ARingIsALoopOfOneNode) {
  const TunnelGraph graph =
      tunnel_graph({line("r", {{0.0, 0.0}, {20.0, 0.0}, {20.0, 20.0}, {0.0, 20.0}, {0.0, 0.0}})});
  EXPECT_EQ(graph.nodes.size(), 1U);
  ASSERT_EQ(graph.edges.size(), 1U);
  EXPECT_DOUBLE_EQ(graph.edges[0].length_m, 80.0);
}

TEST(TunnelGraph, CrossingsCloseToEachOtherAreOneNode) {
  const TunnelGraph graph =
      tunnel_graph({line("a", {{0.0, 0.0}, {20.0, 0.0}}), line("b", {{8.0, 0.0}, {8.0, 10.0}}),
                    line("c", {{8.6, 0.0}, {8.6, -10.0}})});
  EXPECT_EQ(graph.edges.size(), 4U);
  EXPECT_EQ(nodes_of_degree(graph, 4), 1);
}

TEST(TunnelGraph, MarksTheEntrance) {
  TunnelLine mouth = line("a", {{0.0, 0.0}, {20.0, 0.0}});
  mouth.entrance = true;
  const TunnelGraph graph = tunnel_graph({mouth});
  EXPECT_TRUE(graph.nodes[0].entrance);
  EXPECT_FALSE(graph.nodes[1].entrance);
}

}  // namespace
}  // namespace adit
