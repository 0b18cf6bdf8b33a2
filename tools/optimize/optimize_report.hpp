// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "tools/optimize/phase_stopwatch.hpp"

namespace adit {

/// The figures of an optimisation as JSON: size of the graph, objective, iterations,
/// factorisations, whether it converged, and the wall time of its phases in milliseconds.
std::string to_json(const PoseGraph& graph, const OptimizeResult& result,
                    const PhaseStopwatch& stopwatch);

}  // namespace adit
