// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// mission_table MINES..: complete missions in simulated mines with all stages in one process, as a
// table in Markdown. A mine is a world name, random:COUNT for COUNT random mines,
// random_level:COUNT for as many level ones, or two_levels:COUNT for as many with two levels.
#include <array>
#include <chrono>
#include <cstddef>
#include <exception>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "sim/live/world_choice.hpp"
#include "tests/eval/driving/mission_row.hpp"

namespace adit {
namespace {

/// Random mine by number: 40 to 100 m of tunnel, all topologies, undamaged to fully damaged.
WorldChoice mission_mine(const std::string& name, int number) {
  constexpr std::array kTopologies{"parallel_entries", "room_and_pillar", "branching", "ring"};
  constexpr std::array kDamages{0.0, 0.25, 0.5, 0.75, 1.0};
  constexpr std::array kLengthsM{40.0, 60.0, 80.0, 100.0, 50.0, 70.0, 90.0};
  const auto n = static_cast<std::size_t>(number);
  WorldChoice choice;
  choice.name = name;
  choice.seed = number;
  if (name == "two_levels") return choice;
  choice.topology = kTopologies[n % kTopologies.size()];
  choice.damage = kDamages[n % kDamages.size()];
  choice.length_m = kLengthsM[n % kLengthsM.size()];
  return choice;
}

struct Options {
  std::vector<std::string> mines;
  std::optional<int> seed;  // of named worlds
  WorldChoice random;       // length, topology and damage of named random worlds
  int first = 1;
  int jobs = 1;
  MissionRowOptions row;
};

std::vector<MissionRow> rows_of(const Options& options) {
  std::vector<MissionRow> rows;
  for (const std::string& mine : options.mines) {
    const std::string name = mine.substr(0, mine.find(':'));
    const bool is_random = name == "random" || name == "random_level" || name == "two_levels";
    if (!is_random || name == mine) {
      WorldChoice choice = options.random;
      choice.name = mine;
      choice.seed = options.seed;
      rows.push_back({mine, choice, {}});
      continue;
    }
    const int count = std::stoi(mine.substr(name.size() + 1));
    for (int number = options.first; number < options.first + count; ++number) {
      rows.push_back({fmt::format("{}:{}", name, number), mission_mine(name, number), {}});
    }
  }
  return rows;
}

void run(const Options& options) {
  std::vector<MissionRow> rows = rows_of(options);
  const auto start = std::chrono::steady_clock::now();
  run_rows(rows, options.row, options.jobs);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  print_table(rows);
  print_times(rows);
  print_summary(rows, wall.count());
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) try {
  CLI::App app("Runs complete missions in simulated mines, as a table in Markdown");
  adit::Options options;
  app.add_option("MINES", options.mines,
                 "World names, random:COUNT, random_level:COUNT, or two_levels:COUNT")
      ->required();
  app.add_option("--seed", options.seed, "Seed of named worlds, instead of their own");
  app.add_option("--length-m", options.random.length_m,
                 "Approximate length of all tunnels of the worlds random and random_level")
      ->check(CLI::PositiveNumber);
  app.add_option("--topology", options.random.topology, "Topology of these worlds");
  app.add_option("--damage", options.random.damage, "Damaged share of the tunnels of these worlds");
  app.add_option("--first", options.first, "Number of the first random mine")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--jobs", options.jobs, "Number of missions at the same time")
      ->check(CLI::Range(1, 64));
  app.add_option("--out", options.row.folder, "Folder for the subfolders of the missions")
      ->required();
  app.add_option("--config", options.row.config, "YAML file");
  app.add_option("--time-max-s", options.row.time_max_s, "Limit of simulated time for each mission")
      ->check(CLI::PositiveNumber);
  app.add_flag("--keep-logs", options.row.keep_log, "Keep the logs after scoring");
  CLI11_PARSE(app, argc, argv);
  adit::run(options);
  return 0;
} catch (const std::exception& error) {
  std::cerr << "mission_table: " << error.what() << "\n";
  return 2;
}
