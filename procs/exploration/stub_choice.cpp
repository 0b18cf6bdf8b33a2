// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/exploration/stub_choice.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>

namespace adit {
namespace {

/// What all metres of a leg count at least: the gain of coming home early.
double home_weight_m(const std::vector<StubOffer>& offers, const StubChoiceParams& params) {
  const double sum = std::accumulate(offers.begin(), offers.end(), 0.0,
                                     [](double s, const auto& offer) { return s + offer.gain_m; });
  return offers.empty() ? 0.0 : params.home_weight * sum / static_cast<double>(offers.size());
}

/// By subset: the gain of all stubs in it, and of coming home.
std::vector<double> weights_ahead(const std::vector<StubOffer>& offers,
                                  const StubChoiceParams& params) {
  std::vector<double> weights(std::size_t{1} << offers.size(), home_weight_m(offers, params));
  for (std::size_t subset = 1; subset < weights.size(); ++subset) {
    for (std::size_t i = 0; i < offers.size(); ++i) {
      if ((subset >> i & 1U) != 0) weights[subset] += offers[i].gain_m;
    }
  }
  return weights;
}

}  // namespace

bool is_within_budget(const StubOffer& offer, double step_m, double remaining_m,
                      const StubChoiceParams& params) {
  const double home_m = params.home_factor * (offer.home_m + step_m);
  return offer.way_m + step_m + home_m + params.reserve_m <= remaining_m;
}

std::vector<StubOffer> nearest_offers(std::vector<StubOffer> offers, std::optional<int> target,
                                      const StubChoiceParams& params) {
  std::sort(offers.begin(), offers.end(), [&](const StubOffer& a, const StubOffer& b) {
    return std::tuple(a.stub != target, a.way_m, a.stub) <
           std::tuple(b.stub != target, b.way_m, b.stub);
  });
  offers.resize(std::min(offers.size(), static_cast<std::size_t>(params.tour_stubs)));
  std::sort(offers.begin(), offers.end(), [](const StubOffer& a, const StubOffer& b) {
    return std::tie(a.way_m, a.stub) < std::tie(b.way_m, b.stub);
  });
  return offers;
}

std::vector<double> tour_costs(const std::vector<StubOffer>& offers,
                               const Eigen::MatrixXd& between_m, const StubChoiceParams& params) {
  const std::size_t n = offers.size();
  const std::vector<double> ahead = weights_ahead(offers, params);
  const std::size_t all = ahead.size() - 1;
  // By the set of stubs still ahead and the one where the robot is.
  std::vector<double> cost(ahead.size() * n, std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < n; ++i) cost[i] = offers[i].home_m * ahead[0];
  for (std::size_t left = 1; left <= all; ++left) {
    for (std::size_t next = 0; next < n; ++next) {
      if ((left >> next & 1U) == 0) continue;
      const double onward = cost[(left & ~(std::size_t{1} << next)) * n + next];
      for (std::size_t at = 0; at < n; ++at) {
        if ((left >> at & 1U) != 0) continue;
        const double leg =
            between_m(static_cast<Eigen::Index>(at), static_cast<Eigen::Index>(next));
        cost[left * n + at] = std::min(cost[left * n + at], leg * ahead[left] + onward);
      }
    }
  }
  std::vector<double> costs(n);
  for (std::size_t i = 0; i < n; ++i) {
    costs[i] = offers[i].way_m * ahead[all] + cost[(all & ~(std::size_t{1} << i)) * n + i];
  }
  return costs;
}

std::optional<int> choose_stub(const std::vector<StubOffer>& offers,
                               const Eigen::MatrixXd& between_m, std::optional<int> target,
                               const StubChoiceParams& params) {
  if (offers.empty()) return std::nullopt;
  const std::vector<double> costs = tour_costs(offers, between_m, params);
  const auto best =
      static_cast<std::size_t>(std::min_element(costs.begin(), costs.end()) - costs.begin());
  const double all_ahead = weights_ahead(offers, params).back();
  for (std::size_t i = 0; i < offers.size(); ++i) {
    const double saved = costs[i] - costs[best];
    const bool enough = saved > params.switch_gain * offers[i].way_m * all_ahead;
    if (offers[i].stub == target && !enough) return target;
  }
  return offers[best].stub;
}

}  // namespace adit
