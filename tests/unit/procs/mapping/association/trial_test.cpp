// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/association/trial.hpp"

#include <gtest/gtest.h>

#include "common/pose_graph/optimize.hpp"
#include "tests/unit/procs/mapping/association/ring_walk.hpp"

namespace adit {
namespace {

constexpr double kFirstOrder = 0.05;  // relative: the way bends by a few degrees when it is closed

double farthest(const std::vector<Pose2>& a, const std::vector<Pose2>& b) {
  double distance = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    distance = std::max(distance, (a[i].vector() - b[i].vector()).norm());
  }
  return distance;
}

class TrialOnARing : public testing::Test {
 protected:
  TrialOnARing() : problem_(test::problem_of(walk_, closures())) {}

  std::vector<Closure> closures() {
    auto all = walk_.group(205, 3);                          // 0, 1, 2: right
    all.push_back(walk_.closure(20, 220, {0.0, 4.0, 0.0}));  // 3: beside it
    all.push_back(walk_.closure(30, 230));                   // 4: right across
    all.back().alternatives.front().information.row(0).setZero();
    all.back().alternatives.front().information.col(0).setZero();
    all.back().alternatives.front().T_older_newer.x += 2.0;  // and nothing along
    all.push_back(walk_.closure(60, 40, {0.0, 0.0, 2.5}));   // 5: turned round
    return all;
  }

  /// With the poses found anew, from the constraints alone.
  [[nodiscard]] Belief worked_out(std::vector<int> chosen) const {
    Belief belief{std::move(chosen), nothing().T_map_local, 0.0, 0.0};
    PoseGraph graph = graph_of(problem_, belief);
    belief.objective = optimize(graph, {}).objective;
    belief.T_map_local = graph.poses;
    return belief;
  }
  [[nodiscard]] Belief nothing() const { return test::nothing_chosen(problem_); }
  [[nodiscard]] PoseConstraint constraint(int closure) const {
    return constraint_of(problem_.closures[static_cast<std::size_t>(closure)], 0);
  }

  static constexpr int kNo = Association::kNone;
  test::RingWalk walk_{240};
  AssociationProblem problem_;
};

TEST_F(TrialOnARing, PriceIsWhatTheObjectiveThenRisesBy) {
  const Belief before = worked_out({0, kNo, 0, kNo, kNo, kNo});
  Trial trial(problem_, before);
  for (const int k : {1, 3, 4}) {
    std::vector<int> chosen = before.chosen;
    chosen[static_cast<std::size_t>(k)] = 0;
    const double rise = worked_out(chosen).objective - before.objective;
    EXPECT_NEAR(trial.price(constraint(k)), rise, kFirstOrder * rise) << k;
  }
}

TEST_F(TrialOnARing, TakingMovesTheMapsToTheMode) {
  Trial trial(problem_, nothing());
  for (const int k : {0, 2, 4}) trial.take(k, 0);
  trial.settle();
  const Belief found = trial.belief();
  const Belief expected = worked_out({0, kNo, 0, kNo, 0, kNo});
  EXPECT_EQ(found.chosen, expected.chosen);
  EXPECT_NEAR(found.objective, expected.objective, 1e-4 * expected.objective);
  EXPECT_LT(farthest(found.T_map_local, expected.T_map_local), 1e-2);
}

TEST_F(TrialOnARing, RevokingGivesBackWhatWasThereBefore) {
  const Belief before = worked_out({0, kNo, 0, kNo, kNo, kNo});
  Trial trial(problem_, before);
  trial.take(3, 0);
  trial.take(4, 0);
  EXPECT_GT(trial.objective(), before.objective + 1.0);
  EXPECT_GT(farthest(trial.belief().T_map_local, before.T_map_local), 1.0);
  trial.revoke({3, 4});
  const Belief after = trial.belief();
  EXPECT_EQ(after.chosen, before.chosen);
  EXPECT_NEAR(after.objective, before.objective, 1e-4 * before.objective);
  EXPECT_LT(farthest(after.T_map_local, before.T_map_local), 1e-2);
}

TEST_F(TrialOnARing, FindsTheModeWhereAClosureTurnsTheMapsFarRound) {
  Trial trial(problem_, nothing());
  trial.take(0, 0);
  trial.take(5, 0);
  const Belief expected = worked_out({0, kNo, kNo, kNo, kNo, 0});
  trial.settle();
  EXPECT_NEAR(trial.objective(), expected.objective, 1e-3 * expected.objective);
}

TEST_F(TrialOnARing, ForetellsWhatItWouldBeWithoutEach) {
  const Belief before = worked_out({0, kNo, 0, 0, kNo, kNo});
  Trial trial(problem_, before);
  const std::vector<int> chosen = {0, 2, 3};
  const auto without = trial.without_each(chosen, constraint(1));
  ASSERT_EQ(without.size(), chosen.size());
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    std::vector<int> rest = before.chosen;
    rest[static_cast<std::size_t>(chosen[i])] = kNo;
    const Belief undone = worked_out(rest);
    const double fall = before.objective - undone.objective;
    EXPECT_NEAR(without[i].objective_fall, fall, 2.0 * kFirstOrder * before.objective);
    const double rise = Trial(problem_, undone).price(constraint(1));
    EXPECT_NEAR(without[i].rise, rise, 0.1 + 2.0 * kFirstOrder * rise);
  }
}

TEST_F(TrialOnARing, GrowsWithTheProblem) {
  Trial trial(problem_, nothing());
  problem_.closures.push_back(problem_.closures.front());
  problem_.closures.back().id = 6;
  trial.grow();
  EXPECT_EQ(trial.chosen(6), kNo);
  trial.take(6, 0);
  EXPECT_EQ(trial.decisions(), (std::vector<int>{kNo, kNo, kNo, kNo, kNo, kNo, 0}));
}

}  // namespace
}  // namespace adit
