// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "sim/world/drift_line.hpp"

namespace adit {

/// Where a drift is split at a node: the place along it, and that of the node.
struct DriftSplit {
  double s_m = 0.0;                  ///< along the drift
  Eigen::Vector2d p_node{0.0, 0.0};  ///< p_world [m]
};

/// For each drift, in no particular order: where it crosses itself or another, where another ends
/// within half its width, and its own ends.
std::vector<std::vector<DriftSplit>> drift_splits(const std::vector<DriftLine>& drifts);

}  // namespace adit
