// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "tools/plan/scan_plan.hpp"

namespace adit {

/// What came out, for people: a line each, the same for the same scan.
std::vector<std::string> plan_facts(const Cloud& cloud, const ScanPlan& plan);

/// How long it took, a line.
std::string plan_times(const ScanPlan::Times& times);

}  // namespace adit
