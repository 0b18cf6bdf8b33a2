// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "tools/plan/scan_plan.hpp"

namespace adit {

/// The plan as JSON, in level: outcome and reason, figures, goal, points, blocking cells, cells of
/// the ground by what is known of them, and how long the steps took. What is infinite is null.
std::string path_json(const Cloud& cloud, const ScanPlan& plan);

}  // namespace adit
