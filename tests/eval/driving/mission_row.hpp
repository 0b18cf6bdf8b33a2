// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/live/world_choice.hpp"
#include "tests/support/scores/mission_score.hpp"

namespace adit {

/// A mission that is to be run, and what became of it: a row of the table.
struct MissionRow {
  std::string name;
  WorldChoice world;
  test::MissionScore score;
};

struct MissionRowOptions {
  std::filesystem::path folder;  ///< of all missions, one folder for each in it
  std::filesystem::path config;
  double time_max_s = 3600.0;
  bool keep_log = false;
};

/// Runs it in this process and scores it.
test::MissionScore run_row(const MissionRow& row, const MissionRowOptions& options);

/// Runs all, `jobs` at the same time, each in a child process, so that one that dies is a row.
void run_rows(std::vector<MissionRow>& rows, const MissionRowOptions& options, int jobs);

/// As Markdown.
void print_table(const std::vector<MissionRow>& rows);
void print_summary(const std::vector<MissionRow>& rows, double wall_s);

}  // namespace adit
