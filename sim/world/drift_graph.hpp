// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sim/world/drift_line.hpp"
#include "sim/world/world_truth.hpp"

namespace adit {

/// The middles of the drifts as a graph: split where lines cross, or where one ends within half a
/// width of another, to the middle of which it is then led. Nodes less than a metre apart are one.
DriftGraph drift_graph(const std::vector<DriftLine>& drifts);

}  // namespace adit
