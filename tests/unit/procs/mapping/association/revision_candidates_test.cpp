// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/association/revision_candidates.hpp"

#include <algorithm>
#include <optional>

#include <gtest/gtest.h>

#include "tests/unit/procs/mapping/association/ring_walk.hpp"

namespace adit {
namespace {

constexpr double kGate = 21.1;
const Pose2 kBeside{0.0, 4.0, 0.0};

/// The present decisions, and whether the chosen loop closures are `suspects` of the last one.
class RevisionCandidatesOnARing : public testing::Test {
 protected:
  void decide(std::vector<LoopClosure> loop_closures, const std::vector<int>& chosen) {
    problem_ = test::problem_of(walk_, std::move(loop_closures));
    trial_.emplace(problem_, test::nothing_chosen(problem_));
    for (const int k : chosen) trial_->accept(k, 0);
    trial_->reoptimize();
  }

  [[nodiscard]] double cost() const {
    double cost = trial_->objective();
    for (const int chosen : trial_->decisions()) {
      cost += chosen == Association::kNone ? kGate : 0.0;
    }
    return cost;
  }
  std::vector<RevisionCandidate> candidates_of_last() {
    const int last = static_cast<int>(problem_.loop_closures.size()) - 1;
    return revision_candidates(problem_, *trial_, last, kGate, cost());
  }

  test::RingWalk walk_{300};
  AssociationProblem problem_;
  std::optional<Trial> trial_;
};

TEST_F(RevisionCandidatesOnARing, AreTheContradictingOnes) {
  decide(test::together({walk_.group(205, 1, kBeside), walk_.group(225, 2)}), {0});
  const auto found = candidates_of_last();
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found.front().loop_closures, std::vector<int>{0});
  EXPECT_LT(found.front().bound, cost());
}

TEST_F(RevisionCandidatesOnARing, AreEmptyIfNothingIsChosen) {
  decide(walk_.group(205, 3), {});
  EXPECT_TRUE(candidates_of_last().empty());
}

TEST_F(RevisionCandidatesOnARing, AreEmptyIfRevokingCannotLowerTheCost) {
  std::vector<int> chosen(20);
  for (int k = 0; k < 20; ++k) chosen[static_cast<std::size_t>(k)] = k;
  decide(test::together({walk_.group(205, 20), walk_.group(235, 1, kBeside)}), chosen);
  std::fill_n(problem_.groups.begin(), 20, 0);
  EXPECT_TRUE(candidates_of_last().empty());
}

TEST_F(RevisionCandidatesOnARing, AreOrderedByTheirBounds) {
  decide(test::together(
             {walk_.group(205, 2, kBeside), walk_.group(225, 1, kBeside), walk_.group(235, 4)}),
         {0, 1, 2});
  const auto found = candidates_of_last();
  for (std::size_t i = 1; i < found.size(); ++i) EXPECT_GE(found[i].bound, found[i - 1].bound);
}

TEST_F(RevisionCandidatesOnARing, AreTheLatestGroupsInThePapersOrder) {
  decide(walk_.group(205, 6), {0, 1, 2, 3, 5});
  problem_.groups = {0, 0, 1, 1, 1, 2};
  const auto found = latest_groups(problem_, *trial_, 8);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0].loop_closures, (std::vector<int>{5}));
  EXPECT_EQ(found[1].loop_closures, (std::vector<int>{2, 3, 5}));
  EXPECT_EQ(found[2].loop_closures, (std::vector<int>{0, 1, 2, 3, 5}));
  EXPECT_EQ(latest_groups(problem_, *trial_, 2).size(), 2U);
}

}  // namespace
}  // namespace adit
