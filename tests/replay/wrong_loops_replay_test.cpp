// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Lazy data association on the Bicocca data set, whose loop closures come from place recognition; a
// third of them are wrong; and on M3500b, whose odometry loses its heading.
#include <algorithm>

#include <gtest/gtest.h>

#include "common/pose_graph/certified_optimum.hpp"
#include "common/pose_graph/g2o_file.hpp"
#include "common/pose_graph/optimize.hpp"
#include "procs/mapping/association/finished_graph/lazy_loop_closures.hpp"
#include "tests/support/graphs/labelled_graph.hpp"
#include "tests/support/graphs/synthetic_graphs.hpp"
#include "tests/support/recordings.hpp"

namespace adit {
namespace {

using test::LoopLabel;

struct ExpectedResult {
  std::string name;
  int loops;
  int correct_accepted;  // at least
  double rmse_m;         // at most
};

void PrintTo(const ExpectedResult& expected, std::ostream* out) { *out << expected.name; }

class WrongLoopsOfBicocca : public testing::TestWithParam<ExpectedResult> {};

TEST_P(WrongLoopsOfBicocca, AreRejectedAndCorrectOnesAccepted) {
  ADIT_RECORDING_OR_SKIP(g2o, "posegraph/" + GetParam().name + ".g2o");
  ADIT_RECORDING_OR_SKIP(truth, "posegraph/bicocca_ground_truth.txt.gz");
  test::LabelledGraph labelled = test::read_labelled_graph(g2o, truth);
  chain_odometry(labelled.graph);
  const LazyLoopClosuresResult lazy = associate_loops_lazily(labelled.graph, {});
  EXPECT_EQ(std::ssize(lazy.constraint_of_loop_closure), GetParam().loops);
  EXPECT_EQ(test::count_accepted(labelled, lazy.accepted, LoopLabel::kWrong), 0);
  EXPECT_GE(test::count_accepted(labelled, lazy.accepted, LoopLabel::kRight),
            GetParam().correct_accepted);

  ASSERT_TRUE(optimize_accepted(labelled.graph, lazy.accepted).converged);
  EXPECT_LE(test::rmse_m(labelled, labelled.graph.poses), GetParam().rmse_m);
}

INSTANTIATE_TEST_SUITE_P(Replay, WrongLoopsOfBicocca,
                         testing::Values(ExpectedResult{"bicocca_0.150", 350, 190, 1.1},
                                         ExpectedResult{"bicocca_0.500", 122, 116, 1.0}),
                         [](const auto& promise) {
                           return promise.param.name.substr(8, 1) + "_" +
                                  promise.param.name.substr(10);
                         });

TEST(WrongLoopsOfM3500b, AreRejectedThoughTheOdometryLosesItsHeading) {
  ADIT_RECORDING_OR_SKIP(g2o, "posegraph/M3500b.g2o");
  PoseGraph graph = read_g2o(g2o).graph;
  optimize(graph, {});
  certify(graph);
  const auto wrong = test::random_wrong_loops(graph, 500, 1);
  const auto first_wrong = std::ssize(graph.constraints);
  const auto right = std::ranges::count_if(graph.constraints, test::is_loop);
  graph.constraints.insert(graph.constraints.end(), wrong.begin(), wrong.end());
  const LazyLoopClosuresResult lazy = associate_loops_lazily(graph, {});
  EXPECT_EQ(std::count(lazy.accepted.begin() + first_wrong, lazy.accepted.end(), true), 0);
  const auto rejected =
      std::count(lazy.accepted.begin(), lazy.accepted.begin() + first_wrong, false);
  EXPECT_LE(100 * rejected, right);  // a recall of 0.99
  EXPECT_EQ(std::ssize(lazy.history), right + 500);

  graph.poses = lazy.T_map_node;
  const OptimizeResult optimum = optimize_accepted(graph, lazy.accepted, {}, true);
  EXPECT_TRUE(optimum.converged);
  // The global optimum with all right loops is 2054.7; at full weight the objective of the
  // reweighted optimum is larger, by less than a twentieth. A local minimum is at 3400.
  EXPECT_LT(optimum.objective, 1.05 * 2054.7);
}

}  // namespace
}  // namespace adit
