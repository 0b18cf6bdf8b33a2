// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "common/pose_graph/pose_graph.hpp"

namespace adit {

// What others do about wrong loops, to compare with: constraints between nodes that are not
// neighbours get weights that depend on their residuals, and the weighted field is optimised, in
// turn until the weights stay. Both start from chained odometry. Each returns, for every
// constraint, whether it is believed in the end: what is left of it (eᵀ R e) passes the chi-square
// test at 99 %.

/// Weight min(1, δ / |e|) with δ = 1, the default of g2o (Huber 1964).
std::vector<bool> accepted_by_huber(const PoseGraph& graph);

/// Dynamic covariance scaling, weight min(1, 2Φ / (Φ + e²))² with Φ = 1 (Agarwal, Tipaldi,
/// Spinello, Stachniss, Burgard, ICRA 2013).
std::vector<bool> accepted_by_dcs(const PoseGraph& graph);

}  // namespace adit
