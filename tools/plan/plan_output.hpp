// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/plan/scan_plan.hpp"

namespace adit {

/// The plan as JSON, in level: outcome and reason, figures, goal, points, blocking cells, cells of
/// the ground by what is known of them, and how long the steps took. What is infinite is null.
std::string path_json(const Cloud& cloud, const ScanPlan& plan);

/// What came out, for people: a line each, the same for the same scan.
std::vector<std::string> plan_summary(const Cloud& cloud, const ScanPlan& plan);

/// How long it took, a line.
std::string plan_times(const ScanPlan::Times& times);

/// Writes terrain.png, clearance.png, unknown.png, c_space.png, kernels.png, plan.png, sheet.png
/// and path.json into a folder that is there. `planning` has just made the plan. Throws
/// std::runtime_error where a file cannot be written.
void write_plan_files(const std::string& title, const Cloud& cloud, const ScanPlan& plan,
                      const Planning& planning, const Vehicle& vehicle,
                      const std::filesystem::path& folder);

}  // namespace adit
