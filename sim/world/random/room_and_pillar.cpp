// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <limits>

#include "sim/world/random/topologies.hpp"

namespace adit {
namespace {

constexpr double kLengthMin = 120.0;  // minimum for two entries and two crosscuts [m]
constexpr int kCountMax = 60;         // of entries, and of crosscuts

double entry_length(const PanelDescription& panel) {
  return (panel.crosscuts - 1) * panel.crosscut_spacing_m + panel.crosscut_width_m;
}

double tunnel_length(const PanelDescription& panel) {
  return panel.entries * entry_length(panel) +
         panel.crosscuts * (panel.entries - 1) * panel.entry_spacing_m;
}

/// The numbers of entries and crosscuts whose total length is nearest to a length, in a panel that
/// is not too narrow.
void choose_size(double length_m, double slender, PanelDescription& panel) {
  PanelDescription trial = panel;
  double nearest_m = std::numeric_limits<double>::infinity();
  for (trial.entries = 2; trial.entries <= kCountMax; ++trial.entries) {
    for (trial.crosscuts = 2; trial.crosscuts <= kCountMax; ++trial.crosscuts) {
      const double across_m = (trial.entries - 1) * trial.entry_spacing_m;
      const double ratio = entry_length(trial) / (slender * across_m);
      const double off_m = std::abs(tunnel_length(trial) - length_m);
      if (ratio < 0.5 || ratio > 2.0 || off_m >= nearest_m) continue;
      nearest_m = off_m;
      panel = trial;
    }
  }
  panel.length_m = entry_length(panel);
}

}  // namespace

PlanDescription room_and_pillar(double length_m, RandomGenerator& rng) {
  PlanDescription plan;
  if (length_m < kLengthMin) {
    plan.tunnels.push_back(main_tunnel(length_m, rng));
    return plan;
  }
  PanelDescription panel;
  panel.name = "panel";
  panel.entry_width_m = rng.between(3.0, 5.5);
  panel.crosscut_width_m = rng.between(2.6, 4.5);
  panel.entry_spacing_m = panel.entry_width_m + rng.between(5.0, 8.0);
  panel.crosscut_spacing_m = panel.crosscut_width_m + rng.between(8.0, 14.0);
  // The entries extend by half the width of the outer crosscuts, so that the corners are square.
  panel.first_crosscut_m = panel.crosscut_width_m / 2.0;
  choose_size(length_m - kUndamagedLength, rng.between(0.7, 1.6), panel);

  // `main` meets the first crosscut at the midpoint of two entries.
  const double reach_m = kUndamagedLength + panel.crosscut_width_m / 2.0;
  plan.tunnels.push_back(main_tunnel(reach_m, rng));
  const auto& points = plan.tunnels.front().points_m;
  const double below = 0.5 + rng.between(0, panel.entries - 2);
  panel.T_world_panel = {points[points.size() - 2] - panel.first_crosscut_m,
                         points.back() - below * panel.entry_spacing_m, 0.0};
  plan.panels.push_back(panel);
  return plan;
}

}  // namespace adit
