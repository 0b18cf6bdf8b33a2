// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>

#include "common/pose_graph/map_graph.hpp"
#include "tools/eval/trajectory.hpp"

namespace adit {

/// Whether the errors of local maps are as large as their covariances say (Bar-Shalom, Li and
/// Kirubarajan, "Estimation with applications to tracking and navigation", section 5.4: normalised
/// estimation error squared). Errors and covariances are relative to the first local map, along the
/// axes of its frame and in height. Those of one map are correlated: only the shares of many maps
/// together should be 95 %.
struct MapConsistency {
  std::size_t local_maps = 0;                ///< with truth, except the first
  std::array<std::size_t, 3> in_interval{};  ///< of these, x, y and z in the 95 % interval
  std::size_t in_ellipsoid = 0;              ///< of these, the position in the 95 % ellipsoid
  double normalised_error_squared = 0.0;     ///< mean over the local maps; 3 is consistent
};

/// `utimes`: begin of the local maps by id. Nothing if the truth does not cover the first local
/// map, or the graph is not connected.
std::optional<MapConsistency> score_consistency(const MapGraph& graph,
                                                const std::map<int, std::int64_t>& utimes,
                                                const Trajectory& truth);

}  // namespace adit
