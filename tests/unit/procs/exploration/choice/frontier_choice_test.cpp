// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/exploration/choice/frontier_choice.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <set>
#include <stdexcept>

#include <gtest/gtest.h>

namespace adit {
namespace {

/// Points in the plane; two of them are the robot and home.
struct Places {
  std::vector<FrontierCandidate> candidates;
  Eigen::MatrixXd between_m;
};

Places on_a_line(const std::vector<double>& x, double here = 0.0) {
  Places places;
  const auto n = static_cast<Eigen::Index>(x.size());
  places.between_m = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double at = x[static_cast<std::size_t>(i)];
    places.candidates.push_back({static_cast<int>(i), 10.0, std::abs(at - here), std::abs(at)});
    for (Eigen::Index j = 0; j < n; ++j) {
      places.between_m(i, j) = std::abs(at - x[static_cast<std::size_t>(j)]);
    }
  }
  return places;
}

/// Brute force over all orders.
std::vector<double> costs_by_enumeration(const Places& places, const FrontierChoiceParams& params) {
  const std::size_t n = places.candidates.size();
  double sum = 0.0;
  for (const FrontierCandidate& candidate : places.candidates) sum += candidate.gain_m;
  std::vector<double> best(n, 1e300);
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), 0);
  do {
    double ahead = sum + params.home_weight * sum / static_cast<double>(n);
    double cost = places.candidates[order[0]].path_length_m * ahead;
    for (std::size_t k = 0; k < n; ++k) {
      ahead -= places.candidates[order[k]].gain_m;
      const double leg = k + 1 < n ? places.between_m(static_cast<Eigen::Index>(order[k]),
                                                      static_cast<Eigen::Index>(order[k + 1]))
                                   : places.candidates[order[k]].return_length_m;
      cost += leg * ahead;
    }
    best[order[0]] = std::min(best[order[0]], cost);
  } while (std::next_permutation(order.begin(), order.end()));
  return best;
}

TEST(FrontierChoice, FindsTheSameTourAsBruteForce) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> anywhere(-50.0, 50.0);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<double> x(6);
    for (double& each : x) each = anywhere(random);
    Places places = on_a_line(x, anywhere(random));
    for (FrontierCandidate& candidate : places.candidates)
      candidate.gain_m = 30.0 + 0.5 * anywhere(random);
    const auto costs = tour_costs(places.candidates, places.between_m, {});
    const auto expected = costs_by_enumeration(places, {});
    for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(costs[i], expected[i], 1e-6);
  }
}

TEST(FrontierChoice, VisitsFrontiersAlongThePathBeforeFarOnes) {
  const Places places = on_a_line({3.0, -20.0, 25.0});
  EXPECT_EQ(choose_frontier(places.candidates, places.between_m, {}, {}), 0);
}

TEST(FrontierChoice, RetainsTheTargetUnlessAnotherIsClearlyBetter) {
  const Places close = on_a_line({-10.0, 9.5});
  EXPECT_EQ(choose_frontier(close.candidates, close.between_m, {}, {}), 1);
  EXPECT_EQ(choose_frontier(close.candidates, close.between_m, 0, {}), 0);
  const Places clear = on_a_line({-30.0, 5.0});
  EXPECT_EQ(choose_frontier(clear.candidates, clear.between_m, 0, {}), 1);
}

TEST(FrontierChoice, BreaksTiesByTheLowerId) {
  const Places places = on_a_line({-10.0, 10.0});
  EXPECT_EQ(choose_frontier(places.candidates, places.between_m, {}, {}), 0);
  EXPECT_EQ(choose_frontier({}, {}, {}, {}), std::nullopt);
}

TEST(FrontierChoice, AlwaysIncludesTheTarget) {
  FrontierChoiceParams params;
  params.tour_frontiers = 2;
  const auto candidates = nearest_candidates(on_a_line({1, 2, 3, 40}).candidates, 3, params);
  ASSERT_EQ(candidates.size(), 2U);
  EXPECT_EQ(candidates[0].frontier, 0);
  EXPECT_EQ(candidates[1].frontier, 3);
}

TEST(FrontierChoice, NeverSpendsTheBudgetForThePathHome) {
  const FrontierCandidate candidate{0, 10.0, 30.0, 60.0};
  FrontierChoiceParams params;  // 30 + 10 + 1.5 (60 + 10) + 20
  EXPECT_TRUE(is_within_budget(candidate, 10.0, 165.0, params));
  EXPECT_FALSE(is_within_budget(candidate, 10.0, 164.9, params));
}

TEST(FrontierChoice, CountsTheClimbOfThePathHome) {
  FrontierCandidate candidate{0, 10.0, 30.0, 60.0};
  candidate.climb_m = 1.0;
  candidate.return_climb_m = 6.0;
  FrontierChoiceParams params;
  params.climb_factor = 5.0;  // 165 + 5 (1 + 1.5 · 6)
  EXPECT_TRUE(is_within_budget(candidate, 10.0, 215.0, params));
  EXPECT_FALSE(is_within_budget(candidate, 10.0, 214.9, params));
}

}  // namespace
namespace {

constexpr int kNone = -1;

/// Frontiers at points of map as candidates of a body at the origin, with straight paths.
class BaselineRules : public testing::Test {
 protected:
  void frontier_at(double x, double y) {
    Frontier frontier;
    frontier.id = static_cast<int>(frontiers_.size());
    frontier.p_map = {x, y};
    candidates_.push_back({frontier.id, 10.0, frontier.p_map.norm(), 50.0});
    frontiers_.push_back(frontier);
  }
  [[nodiscard]] std::optional<int> choose(const std::string& rule, int target = kNone,
                                          double heading_rad = 0.0) const {
    return choose_by_rule(rule, candidates_, frontiers_, {0.0, 0.0, heading_rad}, target);
  }

  std::vector<Frontier> frontiers_;
  std::vector<FrontierCandidate> candidates_;
};

TEST_F(BaselineRules, ChooseNothingWithoutCandidates) {
  for (const char* rule : {"nearest", "right_hand", "random"}) EXPECT_FALSE(choose(rule));
}

TEST_F(BaselineRules, NearestDoesNotRetainATarget) {
  frontier_at(9.0, 0.0);
  frontier_at(0.0, 5.0);
  EXPECT_EQ(choose("nearest"), 1);
  EXPECT_EQ(choose("nearest", 0), 1);
}

TEST_F(BaselineRules, RightHandDependsOnTheHeading) {
  frontier_at(0.0, 5.0);
  frontier_at(9.0, 0.0);
  frontier_at(0.0, -14.0);
  frontier_at(-1.0, -30.0);  // not near
  EXPECT_EQ(choose("right_hand"), 2);
  EXPECT_EQ(choose("right_hand", kNone, -3.0), 0);  // facing back, left is right
  EXPECT_EQ(choose("right_hand", 1), 1);            // the target, while it is a candidate
}

TEST_F(BaselineRules, RightHandFallsBackToTheNearest) {
  frontier_at(40.0, 0.0);
  frontier_at(0.0, -50.0);
  EXPECT_EQ(choose("right_hand"), 0);
}

TEST_F(BaselineRules, RandomIsDeterministicAndVaries) {
  std::set<int> chosen;
  for (int n = 0; n < 60; ++n) {
    frontier_at(n, 1.0);
    const auto choice = choose("random");
    ASSERT_TRUE(choice);
    EXPECT_EQ(choice, choose("random"));
    EXPECT_EQ(choose("random", 0), 0);
    chosen.insert(*choice);
  }
  // In 60 choices of one in n each new frontier is chosen at most once; at least a third are
  // others.
  EXPECT_GT(chosen.size(), 20U);
}

TEST_F(BaselineRules, RejectAnUnknownRule) {
  frontier_at(1.0, 0.0);
  EXPECT_THROW(static_cast<void>(choose("left_hand")), std::invalid_argument);
}

}  // namespace
}  // namespace adit
