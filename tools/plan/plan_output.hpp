// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/plan/scan_plan.hpp"

namespace adit {

/// Result of the plan as text lines for the terminal and the picture; the same for the same scan.
std::vector<std::string> plan_summary(const Cloud& cloud, const ScanPlan& plan);

/// Computation times as one text line.
std::string plan_times(const ScanPlan::Times& times);

/// Writes terrain.png, clearance.png, unknown.png, c_space.png, kernels.png, plan.png, sheet.png
/// and path.json to an existing folder. `planning` must be in the state after the plan. Throws
/// std::runtime_error if a file cannot be written.
void write_plan_files(const std::string& title, const Cloud& cloud, const ScanPlan& plan,
                      const Planning& planning, const Vehicle& vehicle,
                      const std::filesystem::path& folder);

}  // namespace adit
