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
  std::string rule = "tour";  ///< ours, or one that it is held against: see simple_rules.hpp
  int tour_frontiers = 9;  ///< of the nearest, between which the order is found; time doubles each
  double home_weight = 3.0;  ///< of an early return, in mean gains of a stub
  double switch_gain = 0.2;  ///< share of the way to the target that another has to save
  double home_factor = 1.5;  ///< on the way home: it may be longer than the map says
  double reserve_m = 20.0;   ///< that is never spent

  template <class V>
  void visit(V& v) {
    v("rule", rule, OneOf({"tour", "nearest", "right_hand", "random"}));
    v("tour_frontiers", tour_frontiers, within(1, 14));
    v("home_weight", home_weight, at_least(0.0));
    v("switch_gain", switch_gain, within(0.0, 10.0));
    v("home_factor", home_factor, within(1.0, 10.0));
    v("reserve_m", reserve_m, at_least(0.0));
  }
};

/// A stub as it is weighed.
struct FrontierCandidate {
  int frontier = 0;
  double gain_m = 0.0;           ///< new corridor to be expected there
  double path_length_m = 0.0;    ///< from here
  double return_length_m = 0.0;  ///< from there
};

/// Whether one can go there, look on for `step_m`, and be home within the budget.
bool is_within_budget(const FrontierCandidate& candidate, double step_m, double remaining_m,
                      const FrontierChoiceParams& params);

/// Those between which the order is to be found: the nearest, and the target; by way, then id.
std::vector<FrontierCandidate> nearest_candidates(std::vector<FrontierCandidate> candidates,
                                                  std::optional<int> target,
                                                  const FrontierChoiceParams& params);

/// For each stub the cost of the best tour that begins with it, calls at all others and ends at
/// home: every metre of way counts by the gain that is still ahead, so that what is gained early
/// counts most (front-loaded, after FIG-OP, Peltzer et al. 2022). Exact, by dynamic programming
/// over subsets (Held and Karp 1962). `between_m(i, j)`: from offer i to offer j.
std::vector<double> tour_costs(const std::vector<FrontierCandidate>& candidates,
                               const Eigen::MatrixXd& between_m,
                               const FrontierChoiceParams& params);

/// The first stub of the best tour; the target, unless another tour saves the share of the
/// parameters. Of equals the nearer, then that with the lower id. Nothing where there are none.
std::optional<int> choose_frontier(const std::vector<FrontierCandidate>& candidates,
                                   const Eigen::MatrixXd& between_m, std::optional<int> target,
                                   const FrontierChoiceParams& params);

/// Rules that ours is held against. The same offers, pose and target give the same choice.
///   nearest     the nearest stub, chosen anew each time;
///   right_hand  the rightmost of those within 15 m, seen from the body, otherwise the nearest;
///   random      any, by numbers that the ids of the stubs stand for.
/// The last two keep to a `target` while it is on offer, against pacing back and forth. `stubs`
/// are all, by id. Nothing where there is no offer. Throws std::invalid_argument for another rule.
std::optional<int> choose_by_rule(const std::string& rule,
                                  const std::vector<FrontierCandidate>& candidates,
                                  const std::vector<Frontier>& frontiers, const Pose2& T_map_body,
                                  int target);

}  // namespace adit
