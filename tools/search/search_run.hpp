// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tools/campaign/definition/campaign_plan.hpp"

namespace adit {

struct SearchOptions {
  std::filesystem::path file;
  std::filesystem::path folder;
  std::optional<int> units_max = {};      ///< instead of that of the file
  std::optional<double> time_max_s = {};  ///< wall time of this run; two thirds are for sampling
  int jobs = 0;                           ///< units at the same time; 0: as many as cores allow
  int stop_descriptor = -1;               ///< ends the run when it is readable; see StopSignal
  std::filesystem::path programs = own_program_folder();  ///< folder of adit and adit-watch
};

struct SearchProgress {
  int units = 0;      ///< that have a result
  int units_max = 0;  ///< before the failures are shrunk
  int failures = 0;
  int kinds = 0;
  std::string new_kind;     ///< of the unit that has just ended; empty if it is no new one
  std::string new_kind_id;  ///< id of this unit
  bool is_shrinking = false;
  std::optional<double> time_to_go_s = {};  ///< of sampling
};

/// Failures that are equal but for numbers.
struct FoundKind {
  std::string kind;
  int failures = 0;
  int first_unit = 0;        ///< number of the first unit that failed so
  double first_cpu_s = 0.0;  ///< CPU time of the units up to this one
  CampaignUnit simplest;     ///< as far as it was shrunk
  std::string parameters;    ///< of this unit: those that are not simple, "damage 0.3, seed 2"
  std::string command;       ///< that repeats it, a line for a shell
  int shrink_units = 0;      ///< units that were evaluated to shrink it
  bool is_minimal = false;   ///< false if it was not shrunk to the end
};

struct SearchResult {
  std::string name;
  int units = 0;  ///< that have a result, also of shrinking
  int failures = 0;
  int restarts = 0;
  double cpu_s = 0.0;
  std::vector<FoundKind> kinds;  ///< in the order in which they were found
  bool interrupted = false;      ///< by the stop descriptor
};

/// Searches for failures, shrinks one of each kind, and writes DIR/search.md. Continues what is in
/// the folder: the same file and build give the same units. Throws ConfigError, FileError or
/// std::runtime_error.
SearchResult run_search(const SearchOptions& options,
                        const std::function<void(const SearchProgress&)>& progress);

}  // namespace adit
