// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Lazy data association on the Bicocca data set, whose loop closures come from place recognition; a
// third of them are wrong.
#include <gtest/gtest.h>

#include "common/pose_graph/optimize.hpp"
#include "procs/mapping/association/lazy_loop_closures.hpp"
#include "tests/support/graphs/labelled_graph.hpp"
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

}  // namespace
}  // namespace adit
