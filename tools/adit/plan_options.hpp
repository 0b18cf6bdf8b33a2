// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tools/plan/cloud_placement.hpp"
#include "tools/plan/scan_plan.hpp"
#include "tools/plan/scan_source.hpp"

namespace CLI {
class App;
}

namespace adit {

// The options of `adit plan` by what they are about. What they set must outlive the parsing.
void add_goal_options(CLI::App& command, GoalChoice& goal);
void add_placement_options(CLI::App& command, CloudPlacement& placement);
void add_log_options(CLI::App& command, ScanChoice& choice, bool& list);

}  // namespace adit
