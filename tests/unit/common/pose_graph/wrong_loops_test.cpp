// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "common/pose_graph/optimize.hpp"
#include "common/pose_graph/pose_graph.hpp"
#include "tests/support/graphs/synthetic_graphs.hpp"

namespace adit {
namespace {

double energy_at(const PoseGraph& graph, const PoseConstraint& c) {
  return energy(c, residual(c, graph.poses[static_cast<std::size_t>(c.from)],
                            graph.poses[static_cast<std::size_t>(c.to)]));
}

class WrongLoops : public testing::Test {
 protected:
  PoseGraph graph_ = test::square_trajectory_graph(400, 20, 0.02);
};

TEST_F(WrongLoops, AreTheSameForTheSameSeed) {
  const auto a = test::random_wrong_loops(graph_, 30, 5);
  const auto b = test::random_wrong_loops(graph_, 30, 5);
  ASSERT_EQ(a.size(), 30U);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].T_from_to, b[i].T_from_to);
  EXPECT_NE(a.front().T_from_to, test::random_wrong_loops(graph_, 1, 6).front().T_from_to);
}

TEST_F(WrongLoops, AreWrong) {
  for (const auto& make : {test::random_wrong_loops, test::consistent_wrong_loops}) {
    for (const PoseConstraint& c : make(graph_, 45, 1)) EXPECT_GT(energy_at(graph_, c), 100.0);
  }
}

/// A group of wrong loops alone, added to the odometry from its first to its last node, is as
/// consistent as a correct one.
TEST_F(WrongLoops, AgreeWithEachOtherInAGroup) {
  const auto group = test::consistent_wrong_loops(graph_, 20, 1);
  const auto& first = group.front();
  for (const PoseConstraint& c : group) {
    const auto node = [&](int i) { return graph_.poses[static_cast<std::size_t>(i)]; };
    const Pose2 along_from = between(node(first.from), node(c.from));
    const Pose2 along_to = between(node(first.to), node(c.to));
    const Pose2 claim = along_from * c.T_from_to * along_to.inverse();
    EXPECT_LT(between(first.T_from_to, claim).vector().norm(), 1e-9);
  }
}

}  // namespace
}  // namespace adit
