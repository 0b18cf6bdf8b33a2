// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "common/pose_graph/pose_graph.hpp"

namespace adit {

// Robust kernels of other authors, for comparison, as iteratively reweighted least squares:
// constraints between nodes that are not neighbours get weights that depend on their residuals, and
// the weighted graph is optimized, in turn until the weights converge. The initial guess is chained
// odometry. Each function returns for every constraint whether it is accepted: its final residual
// (eᵀ R e) passes the chi-square test at 99 %.

/// Weight min(1, δ / |e|) with δ = 1, the default of g2o (Huber 1964).
std::vector<bool> accepted_by_huber(const PoseGraph& graph);

/// Dynamic covariance scaling, weight min(1, 2Φ / (Φ + e²))² with Φ = 1 (Agarwal, Tipaldi,
/// Spinello, Stachniss, Burgard, ICRA 2013).
std::vector<bool> accepted_by_dcs(const PoseGraph& graph);

/// Graduated non-convexity with truncated least squares, the odometry known to be right (Yang,
/// Antonante, Tzoumas, Carlone, "Graduated non-convexity for robust spatial perception", RA-L
/// 2020): accepted are the weights above one half.
std::vector<bool> accepted_by_gnc(const PoseGraph& graph);

}  // namespace adit
