// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/exploration/choice/frontier_choice.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <tuple>

#include "common/text/message_text.hpp"

namespace adit {
namespace {

/// Weight of each metre of a leg for returning home early.
double home_weight_m(const std::vector<FrontierCandidate>& candidates,
                     const FrontierChoiceParams& params) {
  const double sum =
      std::accumulate(candidates.begin(), candidates.end(), 0.0,
                      [](double s, const auto& candidate) { return s + candidate.gain_m; });
  return candidates.empty() ? 0.0
                            : params.home_weight * sum / static_cast<double>(candidates.size());
}

/// By subset: the sum of the gains of its frontiers, and of returning home.
std::vector<double> weights_ahead(const std::vector<FrontierCandidate>& candidates,
                                  const FrontierChoiceParams& params) {
  std::vector<double> weights(std::size_t{1} << candidates.size(),
                              home_weight_m(candidates, params));
  for (std::size_t subset = 1; subset < weights.size(); ++subset) {
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      if ((subset >> i & 1U) != 0) weights[subset] += candidates[i].gain_m;
    }
  }
  return weights;
}

}  // namespace

bool is_within_budget(const FrontierCandidate& candidate, double step_m, double remaining_m,
                      const FrontierChoiceParams& params) {
  const double there_m = candidate.path_length_m + params.climb_factor * candidate.climb_m + step_m;
  const double return_m =
      candidate.return_length_m + params.climb_factor * candidate.return_climb_m + step_m;
  return there_m + params.home_factor * return_m + params.reserve_m <= remaining_m;
}

std::vector<FrontierCandidate> nearest_candidates(std::vector<FrontierCandidate> candidates,
                                                  std::optional<int> target,
                                                  const FrontierChoiceParams& params) {
  std::sort(candidates.begin(), candidates.end(),
            [&](const FrontierCandidate& a, const FrontierCandidate& b) {
              return std::tuple(a.frontier != target, a.path_length_m, a.frontier) <
                     std::tuple(b.frontier != target, b.path_length_m, b.frontier);
            });
  candidates.resize(std::min(candidates.size(), static_cast<std::size_t>(params.tour_frontiers)));
  std::sort(candidates.begin(), candidates.end(),
            [](const FrontierCandidate& a, const FrontierCandidate& b) {
              return std::tie(a.path_length_m, a.frontier) < std::tie(b.path_length_m, b.frontier);
            });
  return candidates;
}

std::vector<double> tour_costs(const std::vector<FrontierCandidate>& candidates,
                               const Eigen::MatrixXd& between_m,
                               const FrontierChoiceParams& params) {
  const std::size_t n = candidates.size();
  const std::vector<double> ahead = weights_ahead(candidates, params);
  const std::size_t all = ahead.size() - 1;
  // By the set of frontiers still ahead and the one at which the robot is.
  std::vector<double> cost(ahead.size() * n, std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < n; ++i) cost[i] = candidates[i].return_length_m * ahead[0];
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
    costs[i] =
        candidates[i].path_length_m * ahead[all] + cost[(all & ~(std::size_t{1} << i)) * n + i];
  }
  return costs;
}

std::optional<int> choose_frontier(const std::vector<FrontierCandidate>& candidates,
                                   const Eigen::MatrixXd& between_m, std::optional<int> target,
                                   const FrontierChoiceParams& params) {
  if (candidates.empty()) return std::nullopt;
  const std::vector<double> costs = tour_costs(candidates, between_m, params);
  const auto best =
      static_cast<std::size_t>(std::min_element(costs.begin(), costs.end()) - costs.begin());
  const double all_ahead = weights_ahead(candidates, params).back();
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const double saved = costs[i] - costs[best];
    const bool enough = saved > params.switch_gain * candidates[i].path_length_m * all_ahead;
    if (candidates[i].frontier == target && !enough) return target;
  }
  return candidates[best].frontier;
}

namespace {

constexpr double kNearM = 15.0;

int nearest(const std::vector<FrontierCandidate>& candidates) {
  return std::min_element(candidates.begin(), candidates.end(),
                          [](const FrontierCandidate& a, const FrontierCandidate& b) {
                            return a.path_length_m < b.path_length_m;
                          })
      ->frontier;
}

/// Bearings increase from behind over the right to the left.
int rightmost(const std::vector<FrontierCandidate>& candidates,
              const std::vector<Frontier>& frontiers, const Pose2& T_map_body) {
  int best = nearest(candidates);
  double least = std::numeric_limits<double>::infinity();
  for (const FrontierCandidate& candidate : candidates) {
    if (candidate.path_length_m > kNearM) continue;
    const Eigen::Vector2d p_body =
        T_map_body.inverse() * frontiers[static_cast<std::size_t>(candidate.frontier)].p_map;
    const double bearing = std::atan2(p_body.y(), p_body.x());
    if (bearing >= least) continue;
    least = bearing;
    best = candidate.frontier;
  }
  return best;
}

/// Stateless, so that a restart does not change the choice.
int pseudo_random(const std::vector<FrontierCandidate>& candidates) {
  std::uint64_t state = 42;
  for (const FrontierCandidate& candidate : candidates) {
    state = (state + static_cast<std::uint64_t>(candidate.frontier)) * 6364136223846793005ULL +
            1442695040888963407ULL;  // linear congruential generator MMIX (Knuth)
  }
  return candidates[(state >> 33U) % candidates.size()].frontier;
}

}  // namespace

std::optional<int> choose_by_rule(const std::string& rule,
                                  const std::vector<FrontierCandidate>& candidates,
                                  const std::vector<Frontier>& frontiers, const Pose2& T_map_body,
                                  int target) {
  if (candidates.empty()) return std::nullopt;
  if (rule == "nearest") return nearest(candidates);
  const bool is_candidate =
      std::any_of(candidates.begin(), candidates.end(),
                  [&](const FrontierCandidate& candidate) { return candidate.frontier == target; });
  if (is_candidate) return target;
  if (rule == "right_hand") return rightmost(candidates, frontiers, T_map_body);
  if (rule == "random") return pseudo_random(candidates);
  throw std::invalid_argument(quote(rule) + " is not a rule of exploration");
}

}  // namespace adit
