// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/optimize/optimize_report.hpp"

#include <regex>

#include <nlohmann/json.hpp>

namespace adit {
namespace {

using Json = nlohmann::ordered_json;

void add_loops(Json& json, const LoopVerdicts& loops) {
  json["loops"] = loops.kept.size() + loops.rejected.size();
  json["loops_kept"] = loops.kept;
  json["loops_rejected"] = loops.rejected;
  json["trials"] = loops.trials;
  json["revisions"] = loops.revisions;
}

Json wall_ms(const OptimizeRun& run) {
  Json wall;
  double total = run.stopwatch.total_ms();
  if (run.loops) {
    wall["association"] = run.loops->association_ms;
    total += run.loops->association_ms;
  }
  wall["start"] = run.stopwatch.ms(OptimizePhase::kStart);
  wall["analysis"] = run.stopwatch.ms(OptimizePhase::kAnalysis);
  wall["factorisation"] = run.stopwatch.ms(OptimizePhase::kFactorisation);
  wall["rest"] = run.stopwatch.ms(OptimizePhase::kRest);
  wall["total"] = total;
  return wall;
}

/// [a, b] on one line: the library gives each number its own.
std::string with_short_pairs(const std::string& text) {
  static const std::regex pair(R"(\[\s+(-?\d+),\s+(-?\d+)\s+\])");
  return std::regex_replace(text, pair, "[$1, $2]");
}

}  // namespace

std::string to_json(const PoseGraph& graph, const OptimizeRun& run) {
  Json json = {
      {"nodes", graph.poses.size()},         {"constraints", graph.constraints.size()},
      {"converged", run.result.converged},   {"objective", run.result.objective},
      {"iterations", run.result.iterations}, {"factorisations", run.result.factorisations}};
  if (run.loops) add_loops(json, *run.loops);
  json["wall_ms"] = wall_ms(run);
  return with_short_pairs(json.dump(2));
}

}  // namespace adit
