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
  std::filesystem::path folder;  ///< created if missing; with `choice.all`, a sub-folder per scan
  std::filesystem::path config;  ///< YAML; empty: defaults
  CloudPlacement placement;      ///< used for point clouds only
  ScanChoice choice;             ///< used for logs only
  GoalChoice goal;
  bool logged = false;    ///< the plan of the mission for the goal `choice.id`, instead of `goal`
  std::string estimator;  ///< terrain estimator that overrides the configured one; or empty
};

/// Plans on the selected scans, or as the mission of a log did (logged_plan), writes the files of
/// `write_plan_files` and prints the results to `out` and warnings to `err`. Returns whether every
/// scan has a path. The same input gives the same files except for computation times. Throws
/// std::runtime_error (also ConfigError) or std::invalid_argument, one line, for unusable input.
bool run_plan(const PlanRunOptions& options, std::ostream& out, std::ostream& err);

/// Prints the scans of a log as a table. Throws as run_plan does.
void list_scans(const PlanRunOptions& options, std::ostream& out, std::ostream& err);

}  // namespace adit
