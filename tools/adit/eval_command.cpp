// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>

#include "tools/adit/commands.hpp"
#include "tools/adit/eval_commands.hpp"

namespace adit {

void add_eval_command(CLI::App& adit) {
  CLI::App* eval = adit.add_subcommand("eval", "Measure how good a trajectory or a map is");
  eval->require_subcommand(1);
  add_eval_map_command(*eval);
  add_eval_relations_command(*eval);
}

}  // namespace adit
