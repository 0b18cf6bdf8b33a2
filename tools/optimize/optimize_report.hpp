// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "tools/optimize/optimize_run.hpp"

namespace adit {

/// The figures of an optimisation as JSON: size of the graph, objective, iterations,
/// factorisations, whether it converged, what was decided about loops, and the wall time of the
/// phases in milliseconds. A loop is a pair of ids on one line.
std::string to_json(const PoseGraph& graph, const OptimizeRun& run);

}  // namespace adit
