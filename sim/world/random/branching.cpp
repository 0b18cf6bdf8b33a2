// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <optional>
#include <string>

#include "sim/world/drift_line.hpp"
#include "sim/world/random/topologies.hpp"
#include "sim/world/random/wandering_line.hpp"

namespace adit {
namespace {

constexpr double kShortest = 60.0;        // of which a branch can be spared [m]
constexpr double kMainShare = 0.5;        // of the length
constexpr double kShortestBranch = 12.0;  // [m]
constexpr double kApart = 9.0;            // from middle to middle of drifts that do not meet [m]
constexpr int kTrials = 400;

/// Whether a branch keeps away from all drifts, but for its first metres, which leave one.
bool is_clear(const DriftLine& branch, const std::vector<DriftLine>& drifts) {
  for (double s_m = kApart + 2.0; s_m <= branch.length_m(); s_m += 1.0) {
    const Eigen::Vector2d p_world = branch.at(s_m).p_world;
    const bool near = std::any_of(drifts.begin(), drifts.end(), [&](const DriftLine& drift) {
      return drift.distance_m(p_world) < kApart;
    });
    if (near) return false;
  }
  return true;
}

/// A branch of a drift that is chosen at random; nothing where it has no room.
std::optional<DriftDescription> branch_of(const std::vector<DriftLine>& drifts, double length_m,
                                          Dice& dice) {
  const int last = static_cast<int>(drifts.size()) - 1;
  const int stem = dice.chance(0.5) ? 0 : dice.between(0, last);
  const DriftLine& drift = drifts[static_cast<std::size_t>(stem)];
  const double first_m = stem == 0 ? kSoundLength + 2.0 : 10.0;
  if (drift.length_m() < first_m + 2.0) return std::nullopt;
  const DriftLine::Station at = drift.at(dice.between(first_m, drift.length_m() - 2.0));
  const double heading = at.heading_rad + dice.side() * dice.between(0.9, 1.5);
  DriftDescription branch =
      drift_along("branch_" + std::to_string(drifts.size()),
                  wandering_line(at.p_world, heading, length_m, dice), dice.between(2.5, 4.5));
  PlanDescription alone;
  alone.drifts.push_back(branch);
  if (!is_clear(drift_lines(alone).front(), drifts)) return std::nullopt;
  return branch;
}

}  // namespace

PlanDescription branching(double length_m, Dice& dice) {
  PlanDescription plan;
  const double main_m =
      length_m < kShortest ? length_m : std::max(kMainShare * length_m, kSoundLength + 10.0);
  plan.drifts.push_back(main_drift(main_m, dice));
  double left_m = length_m - main_m;
  for (int i = 0; i < kTrials && left_m > kShortestBranch / 2.0; ++i) {
    const double longest_m = std::max(0.15 * length_m, 2.0 * kShortestBranch);
    const double branch_m =
        std::max(kShortestBranch, std::min(left_m, dice.between(kShortestBranch, longest_m)));
    const auto branch = branch_of(drift_lines(plan), branch_m, dice);
    if (!branch) continue;
    plan.drifts.push_back(*branch);
    left_m -= branch_m;
  }
  return plan;
}

}  // namespace adit
