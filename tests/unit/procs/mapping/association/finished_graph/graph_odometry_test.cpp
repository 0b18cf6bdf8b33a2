// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/association/finished_graph/graph_odometry.hpp"

#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/graphs/synthetic_graphs.hpp"

namespace adit {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr double kAgreement = 21.1;

PoseConstraint step_of(int from, int to, double x) {
  return {from, to, {x, 0.0, 0.0}, 1e4 * Eigen::Matrix3d::Identity()};
}

/// Six poses on a line, one metre apart, without the constraint from pose 2 to pose 3.
PoseGraph broken_line() {
  PoseGraph graph;
  graph.poses.resize(6);
  graph.constraints = {step_of(0, 1, 1.0), step_of(1, 2, 1.0), step_of(3, 4, 1.0),
                       step_of(4, 5, 1.0)};
  return graph;
}

TEST(GraphOdometry, IsTheFirstConstraintBetweenConsecutivePoses) {
  PoseGraph graph = test::square_trajectory_graph(10, 5, 0.0);
  graph.constraints.push_back(step_of(3, 4, 1.0));
  const GraphOdometry odometry(graph, kAgreement);
  EXPECT_THAT(odometry.chain, ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 8));
  EXPECT_THAT(odometry.loops, ElementsAre(9));
  EXPECT_THAT(odometry.bridges, IsEmpty());
}

TEST(GraphOdometry, BridgesAGapByTheConstraintWithWhichMostOthersAgree) {
  PoseGraph graph = broken_line();
  graph.constraints.push_back(step_of(2, 4, 9.0));  // wrong, and the shortest
  graph.constraints.push_back(step_of(5, 0, -5.0));
  graph.constraints.push_back(step_of(1, 4, 3.0));
  const GraphOdometry odometry(graph, kAgreement);
  EXPECT_THAT(odometry.chain, ElementsAre(0, 1, -1, 2, 3));
  EXPECT_THAT(odometry.bridges, ElementsAre(6));
  EXPECT_THAT(odometry.loops, ElementsAre(4, 5));
  EXPECT_NEAR(odometry.steps[2].T_from_to.x, 1.0, 1e-12);
  // The bridge and the steps from pose 2 back to pose 1 and from pose 4 back to pose 3.
  EXPECT_NEAR(odometry.steps[2].covariance(0, 0), 3e-4, 1e-8);
}

TEST(GraphOdometry, BridgesAGapAcrossOtherParts) {
  PoseGraph graph;
  graph.poses.resize(6);
  graph.constraints = {step_of(0, 1, 1.0), step_of(2, 3, 1.0), step_of(4, 5, 1.0),
                       step_of(4, 1, -3.0), step_of(2, 5, 3.0)};
  const GraphOdometry odometry(graph, kAgreement);
  EXPECT_THAT(odometry.chain, ElementsAre(0, -1, 1, -1, 2));
  EXPECT_THAT(odometry.bridges, testing::UnorderedElementsAre(3, 4));
  EXPECT_NEAR(odometry.steps[1].T_from_to.x, 1.0, 1e-12);
  EXPECT_NEAR(odometry.steps[3].T_from_to.x, 1.0, 1e-12);
}

TEST(GraphOdometry, HasAGapWhereTheInformationIsSingular) {
  PoseGraph graph = broken_line();
  graph.constraints.push_back(step_of(2, 3, 1.0));
  graph.constraints.back().information(2, 2) = 0.0;
  EXPECT_THAT(GraphOdometry(graph, kAgreement).bridges, ElementsAre(4));  // nothing better
  graph.constraints.push_back(step_of(1, 3, 2.0));
  const GraphOdometry odometry(graph, kAgreement);
  EXPECT_THAT(odometry.bridges, ElementsAre(5));
  EXPECT_THAT(odometry.loops, ElementsAre(4));
}

TEST(GraphOdometry, RequiresAConnectedGraph) {
  EXPECT_THROW(GraphOdometry(broken_line(), kAgreement), std::invalid_argument);
}

}  // namespace
}  // namespace adit
