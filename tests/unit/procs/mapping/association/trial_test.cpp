// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/association/trial.hpp"

#include <gtest/gtest.h>

#include "common/pose_graph/optimize.hpp"
#include "tests/unit/procs/mapping/association/ring_walk.hpp"

namespace adit {
namespace {

constexpr double kFirstOrder = 0.05;  // relative: loop closures bend the odometry by a few degrees

double farthest(const std::vector<Pose2>& a, const std::vector<Pose2>& b) {
  double distance = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    distance = std::max(distance, (a[i].vector() - b[i].vector()).norm());
  }
  return distance;
}

class TrialOnARing : public testing::Test {
 protected:
  TrialOnARing() : problem_(test::problem_of(walk_, loop_closures())) {}

  std::vector<LoopClosure> loop_closures() {
    auto all = walk_.group(205, 3);                               // 0, 1, 2: correct
    all.push_back(walk_.loop_closure(20, 220, {0.0, 4.0, 0.0}));  // 3: displaced
    all.push_back(walk_.loop_closure(30, 230));                   // 4: correct across,
    all.back().alternatives.front().information.row(0).setZero();
    all.back().alternatives.front().information.col(0).setZero();
    all.back().alternatives.front().T_older_newer.x += 2.0;      // without information along
    all.push_back(walk_.loop_closure(60, 40, {0.0, 0.0, 2.5}));  // 5: turned
    return all;
  }

  /// With the poses optimised again, from the constraints alone.
  [[nodiscard]] Hypothesis optimized_from_scratch(std::vector<int> chosen) const {
    Hypothesis hypothesis{std::move(chosen), nothing().T_map_local, 0.0, 0.0};
    PoseGraph graph = graph_of(problem_, hypothesis);
    hypothesis.objective = optimize(graph, {}).objective;
    hypothesis.T_map_local = graph.poses;
    return hypothesis;
  }
  [[nodiscard]] Hypothesis nothing() const { return test::nothing_chosen(problem_); }
  [[nodiscard]] PoseConstraint constraint(int loop_closure) const {
    return constraint_of(problem_.loop_closures[static_cast<std::size_t>(loop_closure)], 0);
  }

  static constexpr int kNo = Association::kNone;
  test::RingWalk walk_{240};
  AssociationProblem problem_;
};

TEST_F(TrialOnARing, PredictsTheIncreaseOfTheObjective) {
  const Hypothesis before = optimized_from_scratch({0, kNo, 0, kNo, kNo, kNo});
  Trial trial(problem_, before);
  for (const int k : {1, 3, 4}) {
    std::vector<int> chosen = before.chosen;
    chosen[static_cast<std::size_t>(k)] = 0;
    const double increase = optimized_from_scratch(chosen).objective - before.objective;
    EXPECT_NEAR(trial.objective_increase(constraint(k)), increase, kFirstOrder * increase) << k;
  }
}

TEST_F(TrialOnARing, AcceptingMovesTheMapsToTheMode) {
  Trial trial(problem_, nothing());
  for (const int k : {0, 2, 4}) trial.accept(k, 0);
  trial.reoptimize();
  const Hypothesis found = trial.hypothesis();
  const Hypothesis expected = optimized_from_scratch({0, kNo, 0, kNo, 0, kNo});
  EXPECT_EQ(found.chosen, expected.chosen);
  EXPECT_NEAR(found.objective, expected.objective, 1e-4 * expected.objective);
  EXPECT_LT(farthest(found.T_map_local, expected.T_map_local), 1e-2);
}

TEST_F(TrialOnARing, RevokingRestoresThePreviousEstimate) {
  const Hypothesis before = optimized_from_scratch({0, kNo, 0, kNo, kNo, kNo});
  Trial trial(problem_, before);
  trial.accept(3, 0);
  trial.accept(4, 0);
  EXPECT_GT(trial.objective(), before.objective + 1.0);
  EXPECT_GT(farthest(trial.hypothesis().T_map_local, before.T_map_local), 1.0);
  trial.revoke({3, 4});
  const Hypothesis after = trial.hypothesis();
  EXPECT_EQ(after.chosen, before.chosen);
  EXPECT_NEAR(after.objective, before.objective, 1e-4 * before.objective);
  EXPECT_LT(farthest(after.T_map_local, before.T_map_local), 1e-2);
}

TEST_F(TrialOnARing, FindsTheModeAfterALargeRotationOfTheMaps) {
  Trial trial(problem_, nothing());
  trial.accept(0, 0);
  trial.accept(5, 0);
  const Hypothesis expected = optimized_from_scratch({0, kNo, kNo, kNo, kNo, 0});
  trial.reoptimize();
  EXPECT_NEAR(trial.objective(), expected.objective, 1e-3 * expected.objective);
}

TEST_F(TrialOnARing, PredictsTheEffectOfLeavingEachOut) {
  const Hypothesis before = optimized_from_scratch({0, kNo, 0, 0, kNo, kNo});
  Trial trial(problem_, before);
  const std::vector<int> chosen = {0, 2, 3};
  const auto without = trial.leave_one_out(chosen, constraint(1));
  ASSERT_EQ(without.size(), chosen.size());
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    std::vector<int> rest = before.chosen;
    rest[static_cast<std::size_t>(chosen[i])] = kNo;
    const Hypothesis candidate = optimized_from_scratch(rest);
    const double fall = before.objective - candidate.objective;
    EXPECT_NEAR(without[i].objective_decrease, fall, 2.0 * kFirstOrder * before.objective);
    const double increase = Trial(problem_, candidate).objective_increase(constraint(1));
    EXPECT_NEAR(without[i].increase, increase, 0.1 + 2.0 * kFirstOrder * increase);
  }
}

TEST_F(TrialOnARing, GrowsWithTheProblem) {
  Trial trial(problem_, nothing());
  problem_.loop_closures.push_back(problem_.loop_closures.front());
  problem_.loop_closures.back().id = 6;
  trial.add_undecided();
  EXPECT_EQ(trial.chosen(6), kNo);
  trial.accept(6, 0);
  EXPECT_EQ(trial.decisions(), (std::vector<int>{kNo, kNo, kNo, kNo, kNo, kNo, 0}));
}

}  // namespace
}  // namespace adit
