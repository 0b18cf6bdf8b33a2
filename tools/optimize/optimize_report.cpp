// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/optimize/optimize_report.hpp"

#include <nlohmann/json.hpp>

namespace adit {

std::string to_json(const PoseGraph& graph, const OptimizeResult& result,
                    const PhaseStopwatch& stopwatch) {
  const nlohmann::ordered_json json = {
      {"nodes", graph.poses.size()},
      {"constraints", graph.constraints.size()},
      {"converged", result.converged},
      {"objective", result.objective},
      {"iterations", result.iterations},
      {"factorisations", result.factorisations},
      {"wall_ms",
       {{"start", stopwatch.ms(OptimizePhase::kStart)},
        {"analysis", stopwatch.ms(OptimizePhase::kAnalysis)},
        {"factorisation", stopwatch.ms(OptimizePhase::kFactorisation)},
        {"rest", stopwatch.ms(OptimizePhase::kRest)},
        {"total", stopwatch.total_ms()}}}};
  return json.dump(2);
}

}  // namespace adit
