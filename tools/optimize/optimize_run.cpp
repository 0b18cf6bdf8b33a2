// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/optimize/optimize_run.hpp"

#include <algorithm>
#include <chrono>
#include <numeric>
#include <stdexcept>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/pose_graph/growing_optimum.hpp"
#include "common/pose_graph/normal_equations.hpp"
#include "procs/mapping/association/finished_graph/lazy_loop_closures.hpp"

namespace adit {

double PhaseStopwatch::total_ms() const {
  return std::accumulate(ms_.begin(), ms_.begin() + index(OptimizePhase::kEnd), 0.0);
}

void PhaseStopwatch::enter(OptimizePhase begins) {
  const Clock::time_point now = Clock::now();
  ms_[index(phase_)] += std::chrono::duration<double, std::milli>(now - since_).count();
  phase_ = begins;
  since_ = now;
}

namespace {

using Clock = std::chrono::steady_clock;

long id_of(const G2oGraph& file, int node) { return file.ids[static_cast<std::size_t>(node)]; }

void require_poses(const G2oGraph& file, const OptimizeResult& result) {
  if (result.converged || result.reason == OptimizeReason::kNotConverged) return;
  const long id = result.node < 0 ? -1 : id_of(file, result.node);
  throw std::runtime_error(text(result.reason, id));
}

void require_connection(const G2oGraph& file) {
  if (const auto node = first_unconnected_node(file.graph)) {
    throw std::runtime_error(text(OptimizeReason::kUnconnected, id_of(file, *node)));
  }
}

LoopDecisions loop_decisions(const G2oGraph& file, const LazyLoopClosuresResult& lazy) {
  LoopDecisions loops;
  const auto ids_of = [&](int k) -> LoopDecisions::Ids {
    const PoseConstraint& c = file.graph.constraints[static_cast<std::size_t>(k)];
    return {id_of(file, c.from), id_of(file, c.to)};
  };
  for (const int k : lazy.bridges) loops.bridges.push_back(ids_of(k));
  for (const int k : lazy.constraint_of_loop_closure) {
    auto& list = lazy.accepted[static_cast<std::size_t>(k)] ? loops.accepted : loops.rejected;
    list.push_back(ids_of(k));
  }
  loops.doubts = lazy.doubts;
  loops.trials = lazy.trials;
  loops.revisions = static_cast<int>(std::count_if(
      lazy.history.begin(), lazy.history.end(),
      [](const Association& a) { return a.action == Association::Action::kRevised; }));
  return loops;
}

void remove_rejected(PoseGraph& graph, const std::vector<bool>& accepted) {
  std::vector<PoseConstraint> remaining;
  for (std::size_t k = 0; k < accepted.size(); ++k) {
    if (accepted[k]) remaining.push_back(graph.constraints[k]);
  }
  graph.constraints = std::move(remaining);
}

}  // namespace

OptimizeRun optimize_all(G2oGraph& file, bool certify) {
  OptimizeRun run;
  run.result = optimize(file.graph, {}, run.stopwatch.observer());
  require_poses(file, run.result);
  if (!certify && !has_implausible_residual(file.graph)) return run;
  const Clock::time_point begin = Clock::now();
  run.certificate = adit::certify(file.graph);
  run.result.objective = run.certificate->objective;
  run.certify_ms = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
  return run;
}

OptimizeRun optimize_with_runs(G2oGraph& file, const std::vector<std::filesystem::path>& runs,
                               const std::function<void(double)>& progress) {
  OptimizeRun run;
  GrowingOptimum optimum(std::move(file.graph), {}, run.stopwatch.observer());
  run.result = optimum.result();
  require_poses(file, run.result);
  for (const std::filesystem::path& path : runs) {
    if (progress)
      progress(static_cast<double>(run.added.size()) / static_cast<double>(runs.size()));
    const G2oRun further = read_g2o_run(path, file);
    file.ids.insert(file.ids.end(), further.ids.begin(), further.ids.end());
    AddedRun added{path.string(), further.ids.size(), further.constraints.size(), {}, 0.0};
    const Clock::time_point begin = Clock::now();
    added.result = optimum.add(static_cast<int>(further.ids.size()), further.constraints);
    added.wall_ms = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
    try {
      require_poses(file, added.result);
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(fmt::format("{}: {}", path.string(), error.what()));
    }
    run.added.push_back(std::move(added));
  }
  file.graph = optimum.graph();
  return run;
}

OptimizeRun optimize_lazily(G2oGraph& file, const LazyAssociationParams& params,
                            const std::function<void(double)>& progress) {
  require_connection(file);
  const Clock::time_point begin = Clock::now();
  const LazyLoopClosuresResult lazy = associate_loops_lazily(file.graph, params, progress);
  const std::chrono::duration<double, std::milli> association = Clock::now() - begin;

  OptimizeRun run;
  run.loops = loop_decisions(file, lazy);
  run.loops->association_ms = association.count();
  run.result = optimize_accepted(file.graph, lazy, run.stopwatch.observer());
  require_poses(file, run.result);
  if (auto doubt = doubt_of_misfit(lazy, run.result.objective)) {
    run.loops->doubts.push_back(std::move(*doubt));
  }
  remove_rejected(file.graph, lazy.accepted);
  return run;
}

namespace {

using Json = nlohmann::ordered_json;

void add_loops(Json& json, const LoopDecisions& loops) {
  json["loops"] = loops.accepted.size() + loops.rejected.size();
  if (!loops.bridges.empty()) {
    json["odometry_gaps"] = loops.bridges.size();
    json["bridges_trusted"] = loops.bridges;
  }
  if (!loops.doubts.empty()) json["doubtful"] = fmt::format("{}", fmt::join(loops.doubts, "; "));
  json["loops_accepted"] = loops.accepted;
  json["loops_rejected"] = loops.rejected;
  json["trials"] = loops.trials;
  json["revisions"] = loops.revisions;
}

void add_certificate(Json& json, const Certificate& certificate) {
  json["global_minimum"] = certificate.is_global ? "proven" : "not proven";
  json["lower_bound"] = certificate.lower_bound;
  json["replaced_local_minimum"] = certificate.replaced;
  json["relaxation_rank"] = certificate.rank;
}

Json added_runs(const std::vector<AddedRun>& runs) {
  Json json = Json::array();
  for (const AddedRun& run : runs) {
    json.push_back({{"file", run.file},
                    {"poses", run.poses},
                    {"constraints", run.constraints},
                    {"converged", run.result.converged},
                    {"objective", run.result.objective},
                    {"iterations", run.result.iterations},
                    {"factorisations", run.result.factorisations},
                    {"wall_ms", run.wall_ms}});
  }
  return json;
}

Json wall_ms(const OptimizeRun& run) {
  Json wall;
  double total = run.stopwatch.total_ms();
  if (run.loops) {
    wall["association"] = run.loops->association_ms;
    total += run.loops->association_ms;
  }
  if (run.certificate) {
    wall["certificate"] = run.certify_ms;
    total += run.certify_ms;
  }
  wall["start"] = run.stopwatch.ms(OptimizePhase::kStart);
  wall["analysis"] = run.stopwatch.ms(OptimizePhase::kAnalysis);
  wall["factorisation"] = run.stopwatch.ms(OptimizePhase::kFactorisation);
  wall["other"] = run.stopwatch.ms(OptimizePhase::kOther);
  wall["total"] = total;
  return wall;
}

/// Puts [a, b] on one line; the library writes one number per line.
std::string with_pairs_on_one_line(const std::string& text) {
  std::string result;
  bool in_pair = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '[') in_pair = text[text.find_first_not_of(" \n", i + 1)] != '[';  // innermost
    if (c == ']') in_pair = false;
    if (in_pair && (c == ' ' || c == '\n')) continue;
    result += c;
    if (in_pair && c == ',') result += ' ';
  }
  return result;
}

}  // namespace

std::string to_json(const PoseGraph& graph, const OptimizeRun& run) {
  Json json = {
      {"nodes", graph.poses.size()},         {"constraints", graph.constraints.size()},
      {"converged", run.result.converged},   {"objective", run.result.objective},
      {"iterations", run.result.iterations}, {"factorisations", run.result.factorisations}};
  if (run.certificate) add_certificate(json, *run.certificate);
  if (run.loops) add_loops(json, *run.loops);
  json["wall_ms"] = wall_ms(run);
  if (!run.added.empty()) json["added"] = added_runs(run.added);
  return with_pairs_on_one_line(json.dump(2));
}

}  // namespace adit
