// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// exploration_table MINES..: explores simulated mines with a kinematic robot by several rules of
// goal selection, as a table in Markdown. A mine is a world name, or
// random_level:SEED for a level random mine, as all of its walls are those at one height.
#include <algorithm>
#include <exception>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "common/config/config.hpp"
#include "procs/exploration/exploration.hpp"
#include "sim/world/build_world.hpp"
#include "sim/world/random/random_mine.hpp"
#include "sim/world/world_file.hpp"
#include "tests/eval/markdown.hpp"
#include "tests/support/exploration_picture.hpp"
#include "tests/support/robots/exploring_robot.hpp"

namespace adit {
namespace {

constexpr double kBudgetBaseM = 100.0;  // for a mine of any size

struct Options {
  std::vector<std::string> mines;
  std::vector<std::string> rules{"tour", "nearest", "right_hand", "random"};
  double budget_factor = 2.5;
  double distortion_m = 0.0;
  std::filesystem::path config;   // section `exploration`; empty: defaults
  std::filesystem::path picture;  // of the last mine and rule; empty: not drawn
};

World world_of(const std::string& mine) {
  const std::string prefix = "random_level:";
  if (!mine.starts_with(prefix)) return build_world(find_world(mine));
  return build_world(random_mine(std::stoi(mine.substr(prefix.size())), {.level = true}));
}

void print_row(const std::string& mine, const std::string& rule, double corridor_m, double budget_m,
               const test::ExplorationRun& run) {
  std::cout
      << format(
             "| %s | %.0f | %.0f | %s | %.1f | %.1f | %.1f | %.1f | %s | %.0f | %.0f | %.2f | %s ",
             mine.c_str(), corridor_m, budget_m, rule.c_str(), 100 * run.covered_share[0],
             100 * run.covered_share[1], 100 * run.covered_share[2], 100 * run.covered_share[3],
             run.returned ? "yes" : "no", run.missed_m, run.distance_travelled_m,
             run.distance_travelled_m / std::max(1.0, corridor_m * run.covered_share[3]),
             run.complete ? "yes" : "no")
      << format("| %d | %d | %d | %d | %.0f |\n", run.frontiers, run.blocked, run.falsely_blocked,
                run.turns, 1e3 * run.longest_decision_s)
      << std::flush;
}

void print_table(const Options& options) {
  print_heading(
      "| mine | corridor (m) | budget (m) | rule | seen at 25 % | 50 % | 75 % | 100 % | returned "
      "| missed (m) | path length (m) | path length per corridor | complete | frontiers | blocked "
      "| falsely blocked | turns | longest decision (ms) |");
  ExplorationParams params;
  if (!options.config.empty()) {
    params = load_section<ExplorationParams>(ConfigFile::load(options.config), "exploration");
  }
  for (const std::string& mine : options.mines) {
    const test::PlanarMine planar = test::planar_mine(world_of(mine));
    const double budget_m = options.budget_factor * planar.corridor_m() + kBudgetBaseM;
    for (const std::string& rule : options.rules) {
      params.choice.rule = rule;
      Exploration exploration(params);
      const auto run = test::run_exploration(planar, exploration, budget_m, options.distortion_m);
      print_row(mine, rule, planar.corridor_m(), budget_m, run);
      if (options.picture.empty()) continue;
      write_exploration_png(exploration_picture(mine, exploration, run.path_map), options.picture);
    }
  }
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) try {
  CLI::App app("Explores simulated mines with a kinematic robot, as a table in Markdown");
  adit::Options options;
  app.add_option("MINES", options.mines, "World names, or random_level:SEED")->required();
  app.add_option("--rules", options.rules,
                 "Rules: tour (default of exploration), nearest, right_hand, random");
  app.add_option("--budget", options.budget_factor, "Path length per metre of reachable corridor");
  app.add_option("--distortion", options.distortion_m, "Distortion of the map [m]");
  app.add_option("--config", options.config, "YAML file with section exploration");
  app.add_option("--picture", options.picture, "PNG file for the map of the last mine and rule");
  CLI11_PARSE(app, argc, argv);
  adit::print_table(options);
  return 0;
} catch (const std::exception& error) {
  std::cerr << "exploration_table: " << error.what() << "\n";
  return 2;
}
