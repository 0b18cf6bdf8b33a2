// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>

#include <CLI/CLI.hpp>

#include "common/pose_graph/g2o_file.hpp"
#include "tools/adit/commands.hpp"
#include "tools/optimize/optimize_report.hpp"

namespace adit {
namespace {

struct Options {
  std::filesystem::path graph;
  std::filesystem::path out;
  std::string loops = "all";
};

constexpr const char* kFooter =
    R"(Poses are found that agree best with all constraints, the first pose held where it is. They are
found from the constraints alone: the poses in the file, or whether there are any, make no difference
to the answer. The figures come as JSON: the objective (the sum of e' I e over all constraints, as g2o
has it), steps, factorisations, and where the time went, reading and writing left out.

Both spellings are read, plain or gzip: VERTEX_SE2 and EDGE_SE2 (g2o), VERTEX2 and EDGE2 (TORO).

  --loops all      every constraint of the file counts

Examples:
  adit optimize intel.g2o                     the figures
  adit optimize intel.g2o --out best.g2o      and the optimal poses, with the same constraints)";

void optimize_file(const Options& options) {
  G2oGraph file = read_g2o(options.graph);
  PhaseStopwatch stopwatch;
  const OptimizeResult result = optimize(file.graph, {}, stopwatch.observer());
  const bool poses_found = result.converged || result.reason == OptimizeReason::kNotConverged;
  if (!poses_found) {
    const long id = result.node < 0 ? -1 : file.ids[static_cast<std::size_t>(result.node)];
    throw std::runtime_error(options.graph.string() + ": " + text(result.reason, id));
  }
  if (!options.out.empty()) write_g2o(file, options.out);
  std::cout << to_json(file.graph, result, stopwatch) << "\n";
}

}  // namespace

void add_optimize_command(CLI::App& adit) {
  CLI::App* command =
      adit.add_subcommand("optimize", "Find the poses of a pose graph that agree best");
  command->footer(kFooter);
  const auto options = std::make_shared<Options>();
  command->add_option("GRAPH", options->graph, "Poses and constraints, as g2o or TORO write them")
      ->type_name("FILE")
      ->required();
  command->add_option("--out", options->out, "Where the graph goes with its optimal poses")
      ->type_name("FILE");
  command->add_option("--loops", options->loops, "Which loop closures to believe")
      ->check(CLI::IsMember({"all"}))
      ->capture_default_str();
  command->callback([options] { optimize_file(*options); });
}

}  // namespace adit
