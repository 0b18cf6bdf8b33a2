// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/exploration/stub_choice.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

namespace adit {
namespace {

/// Places on a plane, the robot and home at two of them.
struct Places {
  std::vector<StubOffer> offers;
  Eigen::MatrixXd between_m;
};

Places on_a_line(const std::vector<double>& x, double here = 0.0) {
  Places places;
  const auto n = static_cast<Eigen::Index>(x.size());
  places.between_m = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double at = x[static_cast<std::size_t>(i)];
    places.offers.push_back({static_cast<int>(i), 10.0, std::abs(at - here), std::abs(at)});
    for (Eigen::Index j = 0; j < n; ++j) {
      places.between_m(i, j) = std::abs(at - x[static_cast<std::size_t>(j)]);
    }
  }
  return places;
}

/// By trying every order.
std::vector<double> costs_by_trial(const Places& places, const StubChoiceParams& params) {
  const std::size_t n = places.offers.size();
  double sum = 0.0;
  for (const StubOffer& offer : places.offers) sum += offer.gain_m;
  std::vector<double> best(n, 1e300);
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), 0);
  do {
    double ahead = sum + params.home_weight * sum / static_cast<double>(n);
    double cost = places.offers[order[0]].way_m * ahead;
    for (std::size_t k = 0; k < n; ++k) {
      ahead -= places.offers[order[k]].gain_m;
      const double leg = k + 1 < n ? places.between_m(static_cast<Eigen::Index>(order[k]),
                                                      static_cast<Eigen::Index>(order[k + 1]))
                                   : places.offers[order[k]].home_m;
      cost += leg * ahead;
    }
    best[order[0]] = std::min(best[order[0]], cost);
  } while (std::next_permutation(order.begin(), order.end()));
  return best;
}

TEST(StubChoice, FindsTheBestOrderAsTryingAllDoes) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> anywhere(-50.0, 50.0);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<double> x(6);
    for (double& each : x) each = anywhere(random);
    Places places = on_a_line(x, anywhere(random));
    for (StubOffer& offer : places.offers) offer.gain_m = 30.0 + 0.5 * anywhere(random);
    const auto costs = tour_costs(places.offers, places.between_m, {});
    const auto expected = costs_by_trial(places, {});
    for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(costs[i], expected[i], 1e-6);
  }
}

TEST(StubChoice, TakesWhatLiesBesideTheWayBeforeWhatIsFar) {
  const Places places = on_a_line({3.0, -20.0, 25.0});
  EXPECT_EQ(choose_stub(places.offers, places.between_m, {}, {}), 0);
}

TEST(StubChoice, KeepsToItsTargetUnlessAnotherIsClearlyBetter) {
  const Places close = on_a_line({-10.0, 9.5});
  EXPECT_EQ(choose_stub(close.offers, close.between_m, {}, {}), 1);
  EXPECT_EQ(choose_stub(close.offers, close.between_m, 0, {}), 0);
  const Places clear = on_a_line({-30.0, 5.0});
  EXPECT_EQ(choose_stub(clear.offers, clear.between_m, 0, {}), 1);
}

TEST(StubChoice, OfEqualsTakesThatWithTheLowerId) {
  const Places places = on_a_line({-10.0, 10.0});
  EXPECT_EQ(choose_stub(places.offers, places.between_m, {}, {}), 0);
  EXPECT_EQ(choose_stub({}, {}, {}, {}), std::nullopt);
}

TEST(StubChoice, AlwaysWeighsTheTarget) {
  StubChoiceParams params;
  params.tour_stubs = 2;
  const auto offers = nearest_offers(on_a_line({1, 2, 3, 40}).offers, 3, params);
  ASSERT_EQ(offers.size(), 2U);
  EXPECT_EQ(offers[0].stub, 0);
  EXPECT_EQ(offers[1].stub, 3);
}

TEST(StubChoice, NeverSpendsTheWayHome) {
  const StubOffer offer{0, 10.0, 30.0, 60.0};
  StubChoiceParams params;  // 30 + 10 + 1.5 (60 + 10) + 20
  EXPECT_TRUE(is_within_budget(offer, 10.0, 165.0, params));
  EXPECT_FALSE(is_within_budget(offer, 10.0, 164.9, params));
}

}  // namespace
}  // namespace adit
