// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <ostream>
#include <string>

#include "tools/plan/cloud_placement.hpp"
#include "tools/plan/scan_input.hpp"
#include "tools/plan/scan_plan.hpp"

namespace adit {

struct PlanRunOptions {
  std::filesystem::path input;   ///< PLY, PCD, XYZ, or an LCM log
  std::filesystem::path folder;  ///< made if it is not there; with `all` a folder in it for each
  std::filesystem::path config;  ///< YAML, or empty: defaults
  CloudPlacement placement;      ///< of bare points; a log knows
  ScanChoice choice;             ///< of a log
  GoalChoice goal;
  std::string estimator;  ///< of the terrain, instead of the configured one; or empty
};

/// Plans on a scan, or each of several, writes what `write_plan_files` does and says what came out,
/// complaints to `err`. Returns whether there is a path on each. The same input gives the same
/// files but for the times. Throws std::runtime_error (ConfigError among them) and
/// std::invalid_argument, one line, for what cannot be used.
bool run_plan(const PlanRunOptions& options, std::ostream& out, std::ostream& err);

/// Writes the scans of a log as a table.
void list_scans(const PlanRunOptions& options, std::ostream& out, std::ostream& err);

}  // namespace adit
