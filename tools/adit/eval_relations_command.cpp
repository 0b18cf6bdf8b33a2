// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>

#include <CLI/CLI.hpp>

#include "tools/adit/eval_commands.hpp"
#include "tools/eval/relations.hpp"
#include "tools/eval/tum.hpp"

namespace adit {
namespace {

struct EvalRelationsOptions {
  std::filesystem::path relations;
  std::filesystem::path trajectory;
};

constexpr const char* kRelationsFooter =
    R"(The metric of Kümmerle et al., "On measuring the accuracy of SLAM algorithms", Autonomous Robots
2009: each relation compares the motion between two times with the true one, so that an early error
is not counted again and again. The figures come as JSON: mean, standard deviation, median and
maximum of the translational error in metres and of the rotational error in degrees.

Example:
  adit eval relations intel.relations out/trajectory.tum)";

void print_score(const EvalRelationsOptions& options) {
  const auto relations = read_relations(options.relations);
  const RelationsScore score = score_relations(relations, read_tum(options.trajectory));
  if (score.used == 0) {
    throw std::runtime_error("no relation of " + options.relations.string() +
                             " lies within the time of " + options.trajectory.string());
  }
  std::cout << to_json(score) << "\n";
}

}  // namespace

void add_eval_relations_command(CLI::App& eval) {
  CLI::App* relations =
      eval.add_subcommand("relations", "Score a trajectory against hand-verified relations");
  relations->footer(kRelationsFooter);
  const auto options = std::make_shared<EvalRelationsOptions>();
  relations->add_option("RELATIONS", options->relations, "Lines `t1 t2 dx dy dz droll dpitch dyaw`")
      ->type_name("FILE")
      ->required();
  relations->add_option("TRAJECTORY", options->trajectory, "Poses in the TUM format")
      ->type_name("FILE")
      ->required();
  relations->callback([options] { print_score(*options); });
}

}  // namespace adit
