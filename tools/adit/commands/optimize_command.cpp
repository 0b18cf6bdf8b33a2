// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/App.hpp>
#include <fmt/format.h>

#include "common/command_line/command_line.hpp"
#include "common/pose_graph/g2o_file.hpp"
#include "common/text/message_text.hpp"
#include "tools/adit/adit_app.hpp"
#include "tools/adit/progress_bar.hpp"
#include "tools/optimize/optimize_run.hpp"

namespace adit {
namespace {

struct OptimizeOptions {
  std::filesystem::path graph;
  std::filesystem::path out;
  std::string loops = "all";
  std::string order = "best_first";
  bool certify = false;
  std::vector<std::filesystem::path> runs;
};

constexpr const char* kOptimizeDetails =
    R"(Finds the poses that minimize the objective, the sum of e' I e over all constraints as in g2o, with the
first pose fixed. The initial estimate is computed from the constraints; poses in the file are not used.

Input: g2o (VERTEX_SE2, EDGE_SE2) or TORO (VERTEX2, EDGE2), plain or gzip.

Output: JSON on standard output with the objective, the steps, the factorizations and the computation
times without reading and writing. --out writes the optimized graph as g2o.

Global minimum:
  --certify        prove that no poses have a smaller objective, or give a lower bound; if the first minimum
                   is only a local one, find the global one by a semidefinite relaxation
Without --certify this is done only where a residual is larger than noise explains. The output then
includes global_minimum (proven or not proven), lower_bound, replaced_local_minimum and relaxation_rank (0 if
the first minimum was proven).

Loop closures:
  --loops all      accept every constraint
  --loops lazy     accept or reject each loop closure by lazy data association, in the order of the later
                   pose. A loop closure that contradicts earlier decisions revokes them if this increases
                   the likelihood.

With --loops lazy, the first constraint between each pose and the next one in the order of ids is odometry
and is always accepted. Where there is none, or none with information of full rank, the odometry has a gap;
it is bridged by the constraint between its two parts with which most others agree. Bridges are accepted
too, without a test: the output lists them as bridges_trusted, and standard error states their number.
All other constraints are loop closures, also a second one between the same poses. The output
then includes loops_accepted and loops_rejected as [from, to] in the ids of the file, trials (evaluated
alternative sets of decisions) and revisions (decisions that were changed later). A robust kernel reduces
the weight of accepted loop closures with large residuals; the objective sums all accepted constraints
without it.

Runs added to the optimum:
  --add RUN        then add the poses and constraints of another file, whose edges may name poses of GRAPH, and
                   find the optimum of all again by the factorization of GRAPH: seconds instead of minutes on a
                   graph of a million poses. May be repeated. The output then includes, for each run, the
                   objective with it, the steps, the factorizations (0 unless the run changes the graph so much
                   that all was optimized again) and the time.

  --order best_first   revoke first the decisions with the best bound on the likelihood
  --order threshold    revoke the latest decisions first, then earlier ones, until the new loop closure is
                       likely)";

constexpr const char* kOptimizeExamples =
    R"(  adit optimize intel.g2o                       print the figures
  adit optimize intel.g2o --out best.g2o        also write the optimized poses and the same constraints
  adit optimize intel.g2o --certify             prove that the minimum is global
  adit optimize district.g2o --add monday.g2o --add tuesday.g2o --out district_tuesday.g2o
                                                add the runs of two days to a large graph
  adit optimize mine.g2o --loops lazy           find wrong loop closures
  adit optimize mine.g2o --loops lazy --out good.g2o
                                                also write the graph without them, optimized)";

OptimizeRun run_lazy_association(G2oGraph& file, const OptimizeOptions& options) {
  LazyAssociationParams params;
  params.best_first = options.order == "best_first";
  ProgressBar bar("loop closures");
  return optimize_lazily(file, params, [&](double done) { bar.update(done); });
}

OptimizeRun run_with_added(G2oGraph& file, const OptimizeOptions& options) {
  ProgressBar bar("runs added");
  return optimize_with_runs(file, options.runs, [&](double done) { bar.update(done); });
}

OptimizeRun run(G2oGraph& file, const OptimizeOptions& options) {
  try {
    if (!options.runs.empty()) return run_with_added(file, options);
    return options.loops == "lazy" ? run_lazy_association(file, options)
                                   : optimize_all(file, options.certify);
  } catch (const std::exception& error) {
    throw std::runtime_error(fmt::format("{}: {}", options.graph.string(), error.what()));
  }
}

/// States the number of gaps and the first bridges.
void warn_of_gaps(const OptimizeOptions& options, const std::vector<LoopDecisions::Ids>& bridges) {
  constexpr std::size_t kNamedMax = 5;
  std::string names;
  for (std::size_t i = 0; i < std::min(bridges.size(), kNamedMax); ++i) {
    names += fmt::format("{}{} to {}", i > 0 ? ", " : "", bridges[i].first, bridges[i].second);
  }
  if (bridges.size() > kNamedMax) names += ", ..";
  print_error(
      "adit",
      fmt::format("{}: {} in the odometry, bridged by trusted constraints: {}",
                  options.graph.string(),
                  bridges.size() == 1 ? "1 gap" : fmt::format("{} gaps", bridges.size()), names));
}

void warn_of_doubts(const OptimizeOptions& options, const std::vector<std::string>& doubts) {
  print_error("adit",
              fmt::format("{}: doubtful: {}", options.graph.string(), fmt::join(doubts, "; ")));
}

void optimize_file(const OptimizeOptions& options) {
  G2oGraph file = read_g2o(options.graph);
  const OptimizeRun done = run(file, options);
  if (done.loops && !done.loops->bridges.empty()) warn_of_gaps(options, done.loops->bridges);
  if (done.loops && !done.loops->doubts.empty()) warn_of_doubts(options, done.loops->doubts);
  if (!options.out.empty()) write_g2o(file, options.out);
  std::cout << to_json(file.graph, done) << "\n";
}

}  // namespace

void add_optimize_command(CLI::App& adit) {
  CLI::App* command =
      add_command(adit, "optimize",
                  "Optimize a 2D pose graph, on request with rejection of wrong loop closures");
  set_help(*command, {kOptimizeDetails, "", kOptimizeExamples});
  const auto options = std::make_shared<OptimizeOptions>();
  command->add_option("GRAPH", options->graph, "Pose graph in the g2o or TORO format")
      ->type_name("FILE")
      ->required();
  command->add_option("--out", options->out, "Optimized graph to write, as g2o")->type_name("FILE");
  command->add_option("--loops", options->loops, "Loop closures to accept")
      ->check(CLI::IsMember({"all", "lazy"}))
      ->capture_default_str();
  CLI::Option* certify =
      command->add_flag("--certify", options->certify, "Prove that the minimum is global");
  CLI::Option* add =
      command->add_option("--add", options->runs, "Run to add to the optimum; may be repeated")
          ->type_name("FILE")
          ->allow_extra_args(false);
  CLI::Option* order =
      command
          ->add_option("--order", options->order, "Order in which --loops lazy revokes decisions")
          ->check(CLI::IsMember({"best_first", "threshold"}))
          ->capture_default_str();
  command->callback([options, order, certify, add] {
    if (certify->count() > 0 && options->loops == "lazy") {
      throw CLI::ValidationError("--certify", "requires --loops all");
    }
    if (add->count() > 0 && (options->loops == "lazy" || certify->count() > 0)) {
      throw CLI::ValidationError("--add", "requires --loops all and no --certify");
    }
    if (order->count() > 0 && options->loops != "lazy") {
      throw CLI::ValidationError("--order", "requires --loops lazy");
    }
    optimize_file(*options);
  });
}

}  // namespace adit
