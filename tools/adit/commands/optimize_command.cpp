// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>

#include <CLI/CLI.hpp>

#include "common/pose_graph/g2o_file.hpp"
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
};

constexpr const char* kOptimizeFooter =
    R"(Poses are found that agree best with all constraints, the first pose held where it is. They are
found from the constraints alone: the poses in the file, or whether there are any, make no difference
to the answer. The figures come as JSON: the objective (the sum of e' I e over all constraints, as g2o
has it), steps, factorisations, and where the time went, reading and writing left out.

Both spellings are read, plain or gzip: VERTEX_SE2 and EDGE_SE2 (g2o), VERTEX2 and EDGE2 (TORO).

  --loops all      every constraint of the file counts
  --loops lazy     loops may be wrong and are decided upon one after the other, in the order of their
                   later pose, by lazy data association: what fits is taken; where a loop contradicts
                   what was taken before, earlier decisions are undone if that explains more

The first constraint from a pose to the next in the order of ids is the way and is believed; there must
be one for each pose but the last. All others are loops. The figures then have loops_accepted and loops_rejected
as [from, to] in the ids of the file, trials (how many other sets of decisions were worked out) and
revisions (decisions that were changed later). In the optimum, loops that were kept count the less the
worse they fit; the objective is the sum over all that is believed, each in full.

  --order best_first   undo what promises most, by a bound on what it can bring
  --order threshold    undo the latest loops first, then earlier ones too, until the new one is likely

Examples:
  adit optimize intel.g2o                       the figures
  adit optimize intel.g2o --out best.g2o        and the optimal poses, with the same constraints
  adit optimize mine.g2o --loops lazy           which loops are wrong?
  adit optimize mine.g2o --loops lazy --out good.g2o
                                                and the graph without them, with its optimal poses)";

OptimizeRun run_lazy_association(G2oGraph& file, const OptimizeOptions& options) {
  LazyAssociationParams params;
  params.best_first = options.order == "best_first";
  ProgressBar bar("deciding about loops");
  return optimize_lazily(file, params, [&](double done) { bar.update(done); });
}

OptimizeRun run(G2oGraph& file, const OptimizeOptions& options) {
  try {
    return options.loops == "lazy" ? run_lazy_association(file, options) : optimize_all(file);
  } catch (const std::exception& error) {
    throw std::runtime_error(options.graph.string() + ": " + error.what());
  }
}

void optimize_file(const OptimizeOptions& options) {
  G2oGraph file = read_g2o(options.graph);
  const OptimizeRun done = run(file, options);
  if (!options.out.empty()) write_g2o(file, options.out);
  std::cout << to_json(file.graph, done) << "\n";
}

}  // namespace

void add_optimize_command(CLI::App& adit) {
  CLI::App* command =
      adit.add_subcommand("optimize", "Find the poses of a pose graph that agree best");
  command->footer(kOptimizeFooter);
  const auto options = std::make_shared<OptimizeOptions>();
  command->add_option("GRAPH", options->graph, "Poses and constraints, as g2o or TORO write them")
      ->type_name("FILE")
      ->required();
  command->add_option("--out", options->out, "Where the graph goes with its optimal poses")
      ->type_name("FILE");
  command->add_option("--loops", options->loops, "Which loop closures to believe")
      ->check(CLI::IsMember({"all", "lazy"}))
      ->capture_default_str();
  CLI::Option* order =
      command->add_option("--order", options->order, "In which order --loops lazy undoes decisions")
          ->check(CLI::IsMember({"best_first", "threshold"}))
          ->capture_default_str();
  command->callback([options, order] {
    if (order->count() > 0 && options->loops != "lazy") {
      throw CLI::ValidationError("--order", "needs --loops lazy");
    }
    optimize_file(*options);
  });
}

}  // namespace adit
