// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "common/pose_graph/optimize.hpp"
#include "common/pose_graph/pose_graph.hpp"
#include "procs/mapping/association/lazy_association.hpp"

namespace adit {

struct LazyLoopClosuresResult {
  std::vector<bool> accepted;  ///< of each constraint
  std::vector<Association> history;
  /// Which constraint each closure of `history` is.
  std::vector<int> constraint_of_loop_closure;
  int trials = 0;
};

/// Lazy data association on a pose graph whose loops may be wrong: the constraints i → i + 1 (the
/// first of each) are the way, all others closures with the one alternative that they are, and come
/// in the order of their later node. Throws std::invalid_argument, with the node, where the way has
/// a gap. `progress` is called with the share that is done.
LazyLoopClosuresResult associate_loops_lazily(const PoseGraph& graph,
                                              const LazyAssociationParams& params,
                                              const std::function<void(double)>& progress = {});

/// The first pose from which no constraint leads to the next, so that there is no way to hold loops
/// against.
std::optional<int> odometry_gap(const PoseGraph& graph);

/// Moves the poses to the optimum under what is believed. Loops count the less the worse they fit
/// (kernel of Geman and McClure): of a place that was recognised it is certain which it is, not how
/// well it was measured. The result has the steps of all reweightings together, and as objective Σ
/// eᵀ R e over all that is believed, each in full. Poses stay for the same reasons as with
/// `optimize`.
OptimizeResult optimize_accepted(PoseGraph& graph, const std::vector<bool>& accepted,
                                 const OptimizeObserver& observer = {});

}  // namespace adit
