// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/optimize/optimize_run.hpp"

#include <functional>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "common/pose_graph/pose_graph.hpp"
#include "tests/support/graphs/synthetic_graphs.hpp"

namespace adit {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using Ids = LoopDecisions::Ids;

/// 2.5 laps of 80 poses with the ids 1000, 1010, .., and the loop closures of the last poses.
class OptimizeRunTest : public testing::Test {
 protected:
  OptimizeRunTest() {
    file_.graph = test::square_trajectory_graph(200, 20, 0.1);
    for (int i = 0; i < 200; ++i) file_.ids.push_back(1000 + 10 * i);
  }

  void add(const std::vector<PoseConstraint>& loops) {
    auto& constraints = file_.graph.constraints;
    constraints.insert(constraints.end(), loops.begin(), loops.end());
  }
  [[nodiscard]] Ids ids(const PoseConstraint& c) const {
    return {1000 + 10 * c.from, 1000 + 10 * c.to};
  }

  G2oGraph file_;
};

std::string error_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no error";
}

TEST_F(OptimizeRunTest, RemovesWrongLoopsAndListsThemByTheIdsOfTheFile) {
  const G2oGraph correct = file_;
  const auto wrong = test::random_wrong_loops(file_.graph, 5, 1);
  add(wrong);
  const OptimizeRun run = optimize_lazily(file_, {});
  ASSERT_TRUE(run.loops);
  EXPECT_EQ(run.loops->accepted.size(), 120U);
  std::vector<Ids> expected;
  for (const PoseConstraint& c : wrong) expected.push_back(ids(c));
  EXPECT_THAT(run.loops->rejected, testing::UnorderedElementsAreArray(expected));
  EXPECT_EQ(file_.graph.constraints.size(), correct.graph.constraints.size());
  EXPECT_NEAR(run.result.objective, objective(file_.graph), 1e-9);
}

TEST_F(OptimizeRunTest, AgreesWithPlainOptimisationIfAllLoopsAreCorrect) {
  G2oGraph plain = file_;
  const OptimizeRun all = optimize_all(plain);
  EXPECT_FALSE(all.loops);
  const OptimizeRun lazy = optimize_lazily(file_, {});
  EXPECT_THAT(lazy.loops->rejected, IsEmpty());
  EXPECT_GE(lazy.result.objective, all.result.objective);
  EXPECT_NEAR(lazy.result.objective, all.result.objective, 0.01 * all.result.objective);
  for (std::size_t i = 0; i < plain.graph.poses.size(); ++i) {
    const Pose2 difference = between(plain.graph.poses[i], file_.graph.poses[i]);
    EXPECT_LT(difference.vector().norm(), 0.01);  // a tenth of the noise
  }
}

TEST_F(OptimizeRunTest, MeasuresWallTimes) {
  const OptimizeRun run = optimize_lazily(file_, {});
  EXPECT_GT(run.loops->association_ms, 0.0);
  EXPECT_GT(run.stopwatch.ms(OptimizePhase::kFactorisation), 0.0);
}

TEST_F(OptimizeRunTest, ListsTheBridgesOfGapsInTheOdometry) {
  std::erase_if(file_.graph.constraints, [](const auto& c) { return c.from == 4 && c.to == 5; });
  add(test::random_wrong_loops(file_.graph, 5, 1));
  const OptimizeRun run = optimize_lazily(file_, {});
  ASSERT_EQ(run.loops->bridges.size(), 1U);
  const auto [from, to] = run.loops->bridges.front();
  EXPECT_LT(from, 1050);
  EXPECT_GE(to, 1050);
  EXPECT_EQ(to - from, 800);  // one lap: a right loop
  EXPECT_EQ(run.loops->accepted.size(), 119U);
  EXPECT_EQ(run.loops->rejected.size(), 5U);
  const auto json = nlohmann::json::parse(to_json(file_.graph, run));
  EXPECT_EQ(json["odometry_gaps"], 1);
  EXPECT_EQ(json["bridges_trusted"].get<std::vector<Ids>>(), run.loops->bridges);
}

TEST_F(OptimizeRunTest, ReportsAPoseWithoutConstraints) {
  file_.graph.poses.emplace_back();
  file_.ids.push_back(7777);
  EXPECT_THAT(error_of([&] { optimize_all(file_); }), HasSubstr("7777"));
  EXPECT_THAT(error_of([&] { optimize_lazily(file_, {}); }), HasSubstr("7777"));
}

TEST_F(OptimizeRunTest, IsWrittenAsJson) {
  add(test::random_wrong_loops(file_.graph, 2, 1));
  const OptimizeRun run = optimize_lazily(file_, {});
  const std::string text = to_json(file_.graph, run);
  const auto json = nlohmann::json::parse(text);
  EXPECT_EQ(json["nodes"], 200);
  EXPECT_EQ(json["constraints"], 319);
  EXPECT_EQ(json["loops"], 122);
  EXPECT_EQ(json["loops_accepted"].get<std::vector<Ids>>(), run.loops->accepted);
  EXPECT_EQ(json["loops_rejected"].get<std::vector<Ids>>(), run.loops->rejected);
  EXPECT_EQ(json["trials"], run.loops->trials);
  EXPECT_EQ(json["revisions"], run.loops->revisions);
  const auto& wall = json["wall_ms"];
  const double sum = wall["association"].get<double>() + wall["start"].get<double>() +
                     wall["analysis"].get<double>() + wall["factorisation"].get<double>() +
                     wall["other"].get<double>();
  EXPECT_NEAR(wall["total"].get<double>(), sum, 1e-6);
  EXPECT_THAT(text, HasSubstr("[1000, 1800]"));
}

TEST_F(OptimizeRunTest, StatesNoDoubtIfTheNoiseIsAsStated) {
  const OptimizeRun run = optimize_lazily(file_, {});
  EXPECT_THAT(run.loops->doubts, IsEmpty());
  EXPECT_FALSE(nlohmann::json::parse(to_json(file_.graph, run)).contains("doubtful"));
}

/// The odometry has lost its heading, and a single loop cannot correct it.
TEST_F(OptimizeRunTest, StatesItsDoubts) {
  std::erase_if(file_.graph.constraints,
                [](const PoseConstraint& c) { return test::is_loop(c) && c.from > 0; });
  for (PoseConstraint& c : file_.graph.constraints) {
    if (!test::is_loop(c)) c.information = Eigen::Vector3d(100.0, 100.0, 10.0).asDiagonal();
  }
  OptimizeRun run = optimize_lazily(file_, {});
  ASSERT_EQ(run.loops->doubts.size(), 1U);
  EXPECT_THAT(run.loops->doubts.front(), HasSubstr("loses its heading"));
  run.loops->doubts.emplace_back("another doubt");
  const auto json = nlohmann::json::parse(to_json(file_.graph, run));
  EXPECT_EQ(json["doubtful"], run.loops->doubts.front() + "; another doubt");
}

TEST_F(OptimizeRunTest, JsonHasNoLoopsWithoutAssociation) {
  const auto json = nlohmann::json::parse(to_json(file_.graph, optimize_all(file_)));
  EXPECT_FALSE(json.contains("loops_accepted"));
  EXPECT_FALSE(json["wall_ms"].contains("association"));
}

}  // namespace
}  // namespace adit
