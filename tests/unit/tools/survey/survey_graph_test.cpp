// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/frame/survey_graph.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/unit/tools/survey/survey_scene.hpp"
#include "tools/survey/frame/registered_cloud.hpp"

namespace adit {
namespace {

TEST(SurveyGraph, FindsLocalMapsByTimeAndPlace) {
  const SurveyGraph graph = test::graph_along_x(3, 5.0);
  EXPECT_EQ(graph.node_at(test::kSurveyUtime - 1), 0U);
  EXPECT_EQ(graph.node_at(test::kSurveyUtime + 1'500'000), 1U);
  EXPECT_EQ(graph.node_at(test::kSurveyUtime + 9'000'000), 2U);
  EXPECT_EQ(graph.node_near({6.0, 3.0}), 1U);
}

TEST(SurveyGraph, PropagatesTheHeadingErrorAlongALever) {
  std::vector<SurveyGraph::Node> nodes = test::graph_along_x(1, 5.0).nodes();
  nodes[0].covariance = Eigen::Vector3d(0.01, 0.04, 1e-4).asDiagonal();
  nodes[0].z_variance = 0.25;
  const SurveyGraph graph(nodes);
  const Eigen::Matrix3d covariance = graph.covariance_at(0, {10.0, 0.0, 1.0});
  EXPECT_NEAR(covariance(0, 0), 0.01, 1e-12);
  EXPECT_NEAR(covariance(1, 1), 0.04 + 100.0 * 1e-4, 1e-12);
  EXPECT_NEAR(covariance(2, 2), 0.25, 1e-12);
}

/// A chain of two constraints with equal errors.
TEST(SurveyGraph, TakesItsCovariancesFromThePoseGraph) {
  std::vector<LocalMap> maps(3);
  FullMap map;
  const Eigen::Matrix3d information = Eigen::Vector3d(100.0, 100.0, 1e8).asDiagonal();
  for (int i = 0; i < 3; ++i) {
    maps[static_cast<std::size_t>(i)].id = i;
    maps[static_cast<std::size_t>(i)].utime = test::kSurveyUtime + i;
    map.graph.poses.push_back({5.0 * i, 0.0, 0.0});
    map.graph.z_m.push_back(0.1 * i);
    map.graph.z_variance.push_back(0.001 * i);
    if (i == 0) continue;
    map.graph.constraints.push_back({{i - 1, i, {5.0, 0.0, 0.0}, information}});
  }
  for (const LocalMap& local_map : maps) map.local_maps.push_back(&local_map);
  const SurveyGraph graph = SurveyGraph::free_network(map);
  ASSERT_EQ(graph.nodes().size(), 3U);
  EXPECT_NEAR(graph.nodes()[2].covariance(0, 0), 0.02, 1e-9);
  EXPECT_NEAR(graph.nodes()[2].z_variance, 0.002, 1e-12);
  EXPECT_EQ(graph.nodes()[0].covariance(0, 0), 0.0);
}

TEST(RegisteredCloud, PlacesScansByTheirLocalMaps) {
  std::vector<SurveyGraph::Node> nodes = test::graph_along_x(2, 5.0).nodes();
  nodes[1].T_survey_local.z_m = 1.0;
  const SurveyGraph graph(nodes);
  Cloud cloud;
  cloud.utime = test::kSurveyUtime + 1'500'000;
  cloud.T_odom_level = {6.0, 0.0, 0.5 * M_PI};
  cloud.lines.push_back({cloud.utime, {0.0F, 0.0F, 0.6F}, {{2.0F, 0.0F, 0.0F}}, {}});
  const CloudStore clouds = test::stored({cloud});
  const RegisteredCloud registered(clouds, graph);
  std::size_t count = 0;
  registered.for_each_point([&](const SurveyPoint& point) {
    EXPECT_NEAR((point.p_survey - Eigen::Vector3d(6.0, 2.0, 1.0)).norm(), 0.0, 1e-6);
    // Level frame 0.005 rad and a scan 0.0015 rad over 2 m, range 0.01 m.
    EXPECT_NEAR(registered.covariance(point)(2, 2), 1e-4 + 4.0 * (2.5e-5 + 2.25e-6), 1e-9);
    ++count;
  });
  EXPECT_EQ(count, 1U);
  EXPECT_EQ(registered.points(), 1U);
}

}  // namespace
}  // namespace adit
