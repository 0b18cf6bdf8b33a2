// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/pose_graph/pose_graph.hpp"
#include "procs/mapping/association/lazy_association.hpp"

namespace adit {

struct LazyLoopsResult {
  std::vector<bool> believed;  ///< of each constraint
  std::vector<Association> history;
  /// Which constraint each closure of `history` is.
  std::vector<int> constraint_of_closure;
  int trials = 0;
};

/// Lazy data association on a pose graph whose loops may be wrong: the constraints i → i + 1 (the
/// first of each) are the way, all others closures with the one alternative that they are, and come
/// in the order of their later node. Throws std::invalid_argument, with the node, where the way has
/// a gap. `progress` is called with the share that is done.
LazyLoopsResult believe_lazily(const PoseGraph& graph, const LazyAssociationParams& params,
                               const std::function<void(double)>& progress = {});

/// Moves the poses to the optimum under what is believed. Loops count the less the worse they fit
/// (Cauchy's kernel): of a place that was recognised it is certain which it is, not how well it was
/// measured. Returns Σ eᵀ R e over all that is believed.
double optimize_believed(PoseGraph& graph, const std::vector<bool>& believed);

}  // namespace adit
