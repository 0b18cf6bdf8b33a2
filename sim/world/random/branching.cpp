// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "sim/world/plan/tunnel_line.hpp"
#include "sim/world/random/topologies.hpp"

namespace adit {
namespace {

constexpr double kLengthMin = 60.0;        // of which a branch can be spared [m]
constexpr double kMainShare = 0.5;         // of the length
constexpr double kBranchLengthMin = 12.0;  // [m]
constexpr double kSpacingMin = 9.0;        // between centre lines of tunnels that do not meet [m]
constexpr int kTrials = 400;

/// Whether a branch keeps its distance from all tunnels, except along its first metres.
bool is_clear(const TunnelLine& branch, const std::vector<TunnelLine>& tunnels) {
  for (double s_m = kSpacingMin + 2.0; s_m <= branch.length_m(); s_m += 1.0) {
    const Eigen::Vector2d p_world = branch.at(s_m).p_world;
    const bool near = std::any_of(tunnels.begin(), tunnels.end(), [&](const TunnelLine& tunnel) {
      return tunnel.distance_m(p_world) < kSpacingMin;
    });
    if (near) return false;
  }
  return true;
}

/// A branch of a random tunnel; empty if there is no space for it.
std::optional<TunnelDescription> branch_of(const std::vector<TunnelLine>& tunnels, double length_m,
                                           RandomGenerator& rng) {
  const int last = static_cast<int>(tunnels.size()) - 1;
  const int stem = rng.chance(0.5) ? 0 : rng.between(0, last);
  const TunnelLine& tunnel = tunnels[static_cast<std::size_t>(stem)];
  const double first_m = stem == 0 ? kUndamagedLength + 2.0 : 10.0;
  if (tunnel.length_m() < first_m + 2.0) return std::nullopt;
  const TunnelLine::Station at = tunnel.at(rng.between(first_m, tunnel.length_m() - 2.0));
  const double heading = at.heading_rad + rng.side() * rng.between(0.9, 1.5);
  TunnelDescription branch =
      tunnel_along(fmt::format("branch_{}", tunnels.size()),
                   wandering_line(at.p_world, heading, length_m, rng), rng.between(2.5, 4.5));
  PlanDescription alone;
  alone.tunnels.push_back(branch);
  if (!is_clear(tunnel_lines(alone).front(), tunnels)) return std::nullopt;
  return branch;
}

}  // namespace

PlanDescription branching(double length_m, RandomGenerator& rng) {
  PlanDescription plan;
  const double main_m =
      length_m < kLengthMin ? length_m : std::max(kMainShare * length_m, kUndamagedLength + 10.0);
  plan.tunnels.push_back(main_tunnel(main_m, rng));
  double left_m = length_m - main_m;
  for (int i = 0; i < kTrials && left_m > kBranchLengthMin / 2.0; ++i) {
    const double longest_m = std::max(0.15 * length_m, 2.0 * kBranchLengthMin);
    const double branch_m =
        std::max(kBranchLengthMin, std::min(left_m, rng.between(kBranchLengthMin, longest_m)));
    const auto branch = branch_of(tunnel_lines(plan), branch_m, rng);
    if (!branch) continue;
    plan.tunnels.push_back(*branch);
    left_m -= branch_m;
  }
  return plan;
}

}  // namespace adit
