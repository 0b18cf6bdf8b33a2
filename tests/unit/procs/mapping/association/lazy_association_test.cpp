// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/association/lazy_association.hpp"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/procs/mapping/association/ring_walk.hpp"

namespace adit {
namespace {

using test::together;
using testing::Each;
using testing::IsEmpty;

constexpr int kNone = Association::kNone;
const Pose2 kBeside{0.0, 8.0, 0.0};  // as in a parallel tunnel

/// The decisions on groups of loop closures, in order.
std::vector<int> chosen_of(const LazyAssociation& association, int first, int count) {
  const auto& all = association.hypothesis().chosen;
  return {all.begin() + first, all.begin() + first + count};
}

int revisions(const std::vector<Association>& history) {
  return static_cast<int>(std::count_if(history.begin(), history.end(), [](const auto& a) {
    return a.action == Association::Action::kRevised;
  }));
}

/// Parameterised by the order of search.
class BothOrders : public testing::TestWithParam<bool> {
 protected:
  [[nodiscard]] static LazyAssociationParams params() { return {.best_first = GetParam()}; }

  std::vector<Association> decide(const test::RingWalk& walk,
                                  const std::vector<LoopClosure>& loop_closures) {
    return test::drive(association_, walk, loop_closures);
  }

  LazyAssociation association_{params()};
};

INSTANTIATE_TEST_SUITE_P(LazyAssociation, BothOrders, testing::Bool(),
                         [](const auto& order) { return order.param ? "BestFirst" : "Threshold"; });

TEST_P(BothOrders, AcceptCorrectLoopClosures) {
  test::RingWalk walk(300);
  const auto history = decide(walk, together({walk.group(205, 10), walk.group(260, 10)}));
  EXPECT_THAT(association_.hypothesis().chosen, Each(0));
  EXPECT_EQ(history.size(), 20U);
  EXPECT_EQ(revisions(history), 0);
}

TEST_P(BothOrders, RollBackToACheckpoint) {
  test::RingWalk walk(300);
  const auto loop_closures = together({walk.group(205, 10), walk.group(260, 10)});
  decide(walk, loop_closures);
  const Hypothesis before = association_.hypothesis();
  const auto again = [&] {
    association_.add_map(walk.chain.front().T_from_to, walk.chain.front().information);
    return association_.decide({walk.loop_closure(99, 299)}, 0).size();
  };
  const auto checkpoint = association_.checkpoint();
  EXPECT_EQ(again(), 1U);
  association_.roll_back(checkpoint);
  EXPECT_EQ(association_.hypothesis().chosen, before.chosen);
  EXPECT_EQ(association_.hypothesis().T_map_local, before.T_map_local);
  EXPECT_EQ(association_.problem().loop_closures.size(), loop_closures.size());
  EXPECT_EQ(association_.problem().chain.size(), walk.chain.size());
  EXPECT_EQ(again(), 1U);
}

TEST_P(BothOrders, RejectUnlikelyLoopClosures) {
  test::RingWalk walk(300);
  auto far = walk.loop_closure(100, 210);
  far.alternatives.push_back(walk.alternative(80, 210));
  far.alternatives[1].T_older_newer = {};
  far.alternatives[0].T_older_newer = {};
  decide(walk, {far});
  EXPECT_EQ(association_.hypothesis().chosen, std::vector<int>{kNone});
  EXPECT_NEAR(association_.hypothesis().objective, 0.0, 1e-9);
  EXPECT_NEAR(association_.hypothesis().cost, params().gate, 1e-9);
  EXPECT_EQ(association_.trials(), 0);
}

TEST_P(BothOrders, RevokeAnEarlyWrongLoopClosureForSeveralCorrectOnes) {
  test::RingWalk walk(300);
  const auto history = decide(walk, together({walk.group(203, 1, kBeside), walk.group(240, 6)}));
  ASSERT_FALSE(history.empty());
  EXPECT_EQ(history.front().chosen, 0) << "was not accepted at first: nothing to revoke";
  EXPECT_EQ(association_.hypothesis().chosen, (std::vector<int>{kNone, 0, 0, 0, 0, 0, 0}));
  EXPECT_GE(revisions(history), 1);
}

TEST_P(BothOrders, RevokeAConsistentWrongGroupForTwoCorrectGroups) {
  test::RingWalk walk(330);
  const auto history = decide(
      walk, together({walk.group(203, 20, kBeside), walk.group(255, 15), walk.group(290, 15)}));
  ASSERT_GE(history.size(), 20U);
  EXPECT_EQ(history[19].chosen, 0) << "was not accepted at first: nothing to revoke";
  EXPECT_THAT(chosen_of(association_, 0, 20), Each(kNone));
  EXPECT_THAT(chosen_of(association_, 20, 30), Each(0));
}

TEST_P(BothOrders, KeepACorrectGroupAgainstAWrongLoopClosure) {
  test::RingWalk walk(300);
  decide(walk, together({walk.group(203, 20), walk.group(255, 10, kBeside)}));
  EXPECT_THAT(chosen_of(association_, 0, 20), Each(0));
  EXPECT_THAT(chosen_of(association_, 20, 10), Each(kNone));
}

TEST_P(BothOrders, ChooseAnotherAlternativeWhenTheFirstIsContradicted) {
  test::RingWalk walk(300);
  LoopClosure open = walk.loop_closure(3, 203);
  open.alternatives = {walk.alternative(3, 203, kBeside, 10.0), walk.alternative(3, 203, {}, 8.0)};
  const auto history = decide(walk, together({{open}, walk.group(240, 6)}));
  ASSERT_FALSE(history.empty());
  EXPECT_EQ(history.front().chosen, 0) << "was not accepted at first: nothing to revoke";
  EXPECT_EQ(association_.hypothesis().chosen, (std::vector<int>{1, 0, 0, 0, 0, 0, 0}));
}

TEST_P(BothOrders, AcceptLoopClosuresWithADegenerateDirection) {
  test::RingWalk walk(300);
  auto loop_closures = together({walk.group(205, 5), walk.group(260, 5)});
  for (LoopClosure& loop_closure : loop_closures) {
    LoopClosureAlternative& a = loop_closure.alternatives.front();
    a.information.row(0).setZero();
    a.information.col(0).setZero();
    a.T_older_newer =
        a.T_older_newer * Pose2{loop_closure.newer_map % 2 == 0 ? 2.0 : -2.0, 0.0, 0.0};
  }
  decide(walk, loop_closures);
  EXPECT_THAT(association_.hypothesis().chosen, Each(0));
  EXPECT_TRUE(std::isfinite(association_.hypothesis().cost));
}

std::vector<LoopClosure> right_and_wrong(test::RingWalk& walk) {
  LoopClosure open = walk.loop_closure(28, 228);
  open.alternatives = {walk.alternative(28, 228, kBeside, 10.0),
                       walk.alternative(28, 228, {}, 8.0)};
  return together({walk.group(203, 3, kBeside),
                   {open},
                   walk.group(240, 8),
                   walk.group(270, 2, kBeside),
                   walk.group(290, 5)});
}

TEST_P(BothOrders, ReplayTheHistoryToTheSameEstimate) {
  test::RingWalk walk(300);
  auto history = decide(walk, right_and_wrong(walk));
  const auto late = association_.reconsider(300);
  history.insert(history.end(), late.begin(), late.end());
  EXPECT_GE(revisions(history), 1);

  LazyAssociation again(params());
  test::drive(again, walk, {});
  again.restore(history);
  const Hypothesis& expected = association_.hypothesis();
  EXPECT_EQ(again.hypothesis().chosen, expected.chosen);
  EXPECT_NEAR(again.hypothesis().cost, expected.cost, 1e-3 * expected.cost);
  for (std::size_t i = 0; i < expected.T_map_local.size(); ++i) {
    const Pose2 apart = between(expected.T_map_local[i], again.hypothesis().T_map_local[i]);
    EXPECT_LT(apart.vector().norm(), 0.05) << i;  // fields that have not fully converged
  }
}

TEST_P(BothOrders, ProposeEachLoopClosureOnceBeforeRevisions) {
  test::RingWalk walk(300);
  const auto loop_closures = right_and_wrong(walk);
  std::vector<int> decided;
  for (const Association& a : decide(walk, loop_closures)) {
    const auto k = static_cast<std::size_t>(a.loop_closure.id);
    if (a.action == Association::Action::kProposed) {
      EXPECT_EQ(k, decided.size());
      decided.push_back(kNone);
    }
    ASSERT_LT(k, decided.size());
    EXPECT_EQ(a.previously_chosen, decided[k]);
    decided[k] = a.chosen;
  }
  EXPECT_EQ(decided, association_.hypothesis().chosen);
  EXPECT_EQ(decided.size(), loop_closures.size());
}

TEST_P(BothOrders, AreDeterministic) {
  test::RingWalk walk(300);
  const auto loop_closures = right_and_wrong(walk);
  const auto history = decide(walk, loop_closures);
  LazyAssociation again(params());
  EXPECT_EQ(test::drive(again, walk, loop_closures), history);
  EXPECT_EQ(again.hypothesis().T_map_local, association_.hypothesis().T_map_local);
  EXPECT_EQ(again.trials(), association_.trials());
}

TEST(LazyAssociation, IsEmptyWithoutMaps) {
  LazyAssociation association({});
  EXPECT_THAT(association.decide({}, 0), IsEmpty());
  EXPECT_THAT(association.reconsider(0), IsEmpty());
  EXPECT_THAT(association.hypothesis().T_map_local, IsEmpty());
}

TEST(LazyAssociation, FollowsTheOdometryWithoutLoopClosures) {
  const test::RingWalk walk(50);
  LazyAssociation association({});
  test::drive(association, walk, {});
  const UncertainPose end = association.problem().odometry.between(0, 49);
  const Pose2 apart = between(end.T_from_to, association.hypothesis().T_map_local.back());
  EXPECT_LT(apart.vector().norm(), 1e-9);
}

}  // namespace
}  // namespace adit
