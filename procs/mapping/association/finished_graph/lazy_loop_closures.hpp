// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/pose_graph/optimize.hpp"
#include "common/pose_graph/pose_graph.hpp"
#include "procs/mapping/association/lazy_association.hpp"

namespace adit {

struct LazyLoopClosuresResult {
  std::vector<bool> accepted;  ///< of each constraint
  std::vector<Association> history;
  /// Index of the constraint of each loop closure in `history`, by its id.
  std::vector<int> constraint_of_loop_closure;
  /// Indices of the constraints that bridge gaps of the odometry (GraphOdometry) and are trusted.
  std::vector<int> bridges;
  int trials = 0;
  /// The optimum under the accepted constraints, where it needs a better start than `optimize` has:
  /// where the odometry loses its heading (LoopConsensus). Otherwise empty.
  std::vector<Pose2> T_map_node;
  /// Why accepted loops may be wrong or the poses not the best, one sentence each, for display.
  std::vector<std::string> doubts;
};

/// Lazy data association on a pose graph with possibly wrong loops: the constraints i → i + 1 (the
/// first of each) and those that bridge gaps are the odometry (GraphOdometry), all others are loop
/// closures with one alternative, decided in the order of LoopQueue; or together by
/// `find_consensus`, where the odometry loses its heading and the optimum of that is proven. Throws
/// std::invalid_argument, naming the node, if the graph is not connected. `progress` is called with
/// the share that is done.
LazyLoopClosuresResult associate_loops_lazily(const PoseGraph& graph,
                                              const LazyAssociationParams& params,
                                              const std::function<void(double)>& progress = {});

/// Moves the poses to the optimum under the accepted constraints. Loops are down-weighted by their
/// residuals (kernel of Geman and McClure): an accepted loop identifies the right place, but its
/// measurement may still be inaccurate. The result counts the steps of all reweightings; its
/// objective is Σ eᵀ R e over all accepted constraints at full weight. Poses are unchanged for the
/// same reasons as with `optimize`. With `from_poses` the poses of the graph are the start.
OptimizeResult optimize_accepted(PoseGraph& graph, const std::vector<bool>& accepted,
                                 const OptimizeObserver& observer = {}, bool from_poses = false);

/// The same for the constraints that `result` accepts, from the poses of `result` where it has any.
OptimizeResult optimize_accepted(PoseGraph& graph, const LazyLoopClosuresResult& result,
                                 const OptimizeObserver& observer = {});

/// A sentence if `objective`, that of `optimize_accepted`, is more than four times the expectation
/// for the accepted loops: wrong loops that agree with each other leave such a tension in the map.
std::optional<std::string> doubt_of_misfit(const LazyLoopClosuresResult& result, double objective);

}  // namespace adit
