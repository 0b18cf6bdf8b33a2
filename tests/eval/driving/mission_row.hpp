// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/live/world_choice.hpp"
#include "tests/support/scores/mission_score.hpp"

namespace adit {

/// A mission in a simulated mine and its score: a row of the table.
struct MissionRow {
  std::string name;
  WorldChoice world;
  test::MissionScore score;
};

struct MissionRowOptions {
  std::filesystem::path folder;  ///< holds a subfolder for each mission
  std::filesystem::path config;
  double time_max_s = 3600.0;
  bool keep_log = false;
};

/// Runs a mission in this process and scores it.
test::MissionScore run_row(const MissionRow& row, const MissionRowOptions& options);

/// Runs all missions, `jobs` at the same time. Each runs in a child process, so that a crash is
/// recorded in its row.
void run_rows(std::vector<MissionRow>& rows, const MissionRowOptions& options, int jobs);

/// Prints the rows and their sums as tables in Markdown.
void print_table(const std::vector<MissionRow>& rows);
/// What the time of each mission went to: seconds by Activity, then the sums with numbers and
/// speeds.
void print_times(const std::vector<MissionRow>& rows);
void print_summary(const std::vector<MissionRow>& rows, double wall_s);

}  // namespace adit
