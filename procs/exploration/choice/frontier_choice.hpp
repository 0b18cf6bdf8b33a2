// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/config/bounds.hpp"
#include "common/geometry/pose2.hpp"
#include "common/types/exploration.hpp"

namespace adit {

struct FrontierChoiceParams {
  std::string rule = "tour";  ///< tour, or a baseline: see choose_by_rule
  int tour_frontiers = 9;     ///< nearest frontiers that enter the tour; each one doubles the time
  double home_weight = 3.0;   ///< gain of an early return, in mean gains of a frontier
  double switch_gain = 0.2;   ///< saving that changes the target, as a share of the path to it
  double home_factor = 1.5;   ///< safety factor on the path home
  double reserve_m = 20.0;    ///< path length that is never planned for
  /// Path length on level ground that takes as much energy as a metre of climb: the inverse of the
  /// rolling resistance, here 0.15. What else the vehicle draws makes it less.
  double climb_factor = 6.7;

  template <class V>
  void visit(V& v) {
    v("rule", rule, OneOf({"tour", "nearest", "right_hand", "random"}));
    v("tour_frontiers", tour_frontiers, within(1, 14));
    v("home_weight", home_weight, at_least(0.0));
    v("switch_gain", switch_gain, within(0.0, 10.0));
    v("home_factor", home_factor, within(1.0, 10.0));
    v("reserve_m", reserve_m, at_least(0.0));
    v("climb_factor", climb_factor, at_least(0.0));
  }
};

/// A frontier with its gain and cost.
struct FrontierCandidate {
  int frontier = 0;
  double gain_m = 0.0;           ///< expected length of new corridor
  double path_length_m = 0.0;    ///< from the robot
  double return_length_m = 0.0;  ///< from the frontier home
  double climb_m = 0.0;          ///< on the path to it,
  double return_climb_m = 0.0;   ///< and on the path home
};

/// Whether the robot can go to the frontier, explore `step_m` beyond it, and return home within the
/// budget. A climb counts as the path length that takes the same energy.
bool is_within_budget(const FrontierCandidate& candidate, double step_m, double remaining_m,
                      const FrontierChoiceParams& params);

/// The candidates of a tour: the nearest ones, and the target; ordered by path length, then id.
std::vector<FrontierCandidate> nearest_candidates(std::vector<FrontierCandidate> candidates,
                                                  std::optional<int> target,
                                                  const FrontierChoiceParams& params);

/// For each frontier the cost of the best tour that begins with it, visits all others and ends at
/// home. Each metre is weighted by the gain that is still ahead, so that early gain counts most
/// (front-loaded, after FIG-OP, Peltzer et al. 2022). Exact, by dynamic programming over subsets
/// (Held and Karp 1962). `between_m(i, j)`: path length from candidate i to candidate j.
std::vector<double> tour_costs(const std::vector<FrontierCandidate>& candidates,
                               const Eigen::MatrixXd& between_m,
                               const FrontierChoiceParams& params);

/// The first frontier of the best tour, or the target, unless the best tour saves more than
/// `switch_gain`. Ties: the nearer one, then the lower id. Empty if there are no candidates.
std::optional<int> choose_frontier(const std::vector<FrontierCandidate>& candidates,
                                   const Eigen::MatrixXd& between_m, std::optional<int> target,
                                   const FrontierChoiceParams& params);

/// Baselines for comparison. Deterministic: the same candidates, pose and target give the same
/// choice.
///   nearest     the nearest frontier, chosen again in each call (Yamauchi 1997);
///   right_hand  the rightmost of those within 15 m, as seen from body, otherwise the nearest;
///   random      pseudo-random, seeded by the ids of the candidates.
/// The last two retain a `target` while it is a candidate, to avoid oscillation. `frontiers`: all,
/// by id. Empty if there are no candidates. Throws std::invalid_argument for an unknown rule.
std::optional<int> choose_by_rule(const std::string& rule,
                                  const std::vector<FrontierCandidate>& candidates,
                                  const std::vector<Frontier>& frontiers, const Pose2& T_map_body,
                                  int target);

}  // namespace adit
