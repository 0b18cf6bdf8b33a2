// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>

#include "tools/eval/trajectory.hpp"

namespace adit {

/// Whether a map confuses places above each other, or far from each other.
struct LevelConsistency {
  std::size_t loop_closures = 0;
  /// Of these, those between levels: where the true paths of both local maps are nearest to each
  /// other in plan, their heights differ by more than ground and its steepest slope can.
  std::size_t between_levels = 0;
  /// True path length that the map shows within a metre of a place that is elsewhere [m].
  double merged_m = 0.0;
};

/// `loop_closures`: pairs of local maps that were ever linked. `utimes`: begin of the local maps by
/// id. `mapped`: the path by the last graph.
LevelConsistency score_levels(const std::set<std::array<int, 2>>& loop_closures,
                              const std::map<int, std::int64_t>& utimes, const Trajectory& mapped,
                              const Trajectory& truth);

}  // namespace adit
