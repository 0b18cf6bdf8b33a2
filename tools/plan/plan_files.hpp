// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "tools/plan/scan_plan.hpp"

namespace adit {

/// Writes terrain.png, clearance.png, unknown.png, c_space.png, kernels.png, plan.png, sheet.png
/// and path.json into a folder that is there. `planning` has just made the plan. Throws
/// std::runtime_error where a file cannot be written.
void write_plan_files(const std::string& title, const Cloud& cloud, const ScanPlan& plan,
                      const Planning& planning, const Vehicle& vehicle,
                      const std::filesystem::path& folder);

}  // namespace adit
