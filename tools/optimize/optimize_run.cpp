// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/optimize/optimize_run.hpp"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <string>

#include "procs/mapping/association/lazy_loops.hpp"

namespace adit {
namespace {

using Clock = std::chrono::steady_clock;

long id_of(const G2oGraph& file, int node) { return file.ids[static_cast<std::size_t>(node)]; }

void require_poses(const G2oGraph& file, const OptimizeResult& result) {
  if (result.converged || result.reason == OptimizeReason::kNotConverged) return;
  const long id = result.node < 0 ? -1 : id_of(file, result.node);
  throw std::runtime_error(text(result.reason, id));
}

void require_way(const G2oGraph& file) {
  const auto gap = gap_in_way(file.graph);
  if (!gap) return;
  throw std::runtime_error("no constraint links pose " + std::to_string(id_of(file, *gap)) +
                           " with the next, pose " + std::to_string(id_of(file, *gap + 1)) +
                           ": there is no way to hold loops against");
}

LoopVerdicts verdicts(const G2oGraph& file, const LazyLoopsResult& lazy) {
  LoopVerdicts loops;
  for (const int k : lazy.constraint_of_closure) {
    const PoseConstraint& c = file.graph.constraints[static_cast<std::size_t>(k)];
    auto& list = lazy.believed[static_cast<std::size_t>(k)] ? loops.kept : loops.rejected;
    list.emplace_back(id_of(file, c.from), id_of(file, c.to));
  }
  loops.trials = lazy.trials;
  loops.revisions = static_cast<int>(std::count_if(
      lazy.history.begin(), lazy.history.end(),
      [](const Association& a) { return a.action == Association::Action::kRevised; }));
  return loops;
}

void leave_out(PoseGraph& graph, const std::vector<bool>& believed) {
  std::vector<PoseConstraint> kept;
  for (std::size_t k = 0; k < believed.size(); ++k) {
    if (believed[k]) kept.push_back(graph.constraints[k]);
  }
  graph.constraints = std::move(kept);
}

}  // namespace

OptimizeRun optimize_all(G2oGraph& file) {
  OptimizeRun run;
  run.result = optimize(file.graph, {}, run.stopwatch.observer());
  require_poses(file, run.result);
  return run;
}

OptimizeRun optimize_lazily(G2oGraph& file, const LazyAssociationParams& params,
                            const std::function<void(double)>& progress) {
  require_way(file);
  const Clock::time_point begin = Clock::now();
  const LazyLoopsResult lazy = believe_lazily(file.graph, params, progress);
  const std::chrono::duration<double, std::milli> association = Clock::now() - begin;

  OptimizeRun run;
  run.loops = verdicts(file, lazy);
  run.loops->association_ms = association.count();
  run.result = optimize_believed(file.graph, lazy.believed, run.stopwatch.observer());
  require_poses(file, run.result);
  leave_out(file.graph, lazy.believed);
  return run;
}

}  // namespace adit
