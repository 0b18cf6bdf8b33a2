// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "tools/report/mission_statistics.hpp"

namespace adit {

// Sections of the page of a mission, html.

/// The figures that matter, and the rest of them in a fold.
std::string metrics_html(const MissionStatistics& statistics, const MissionRecords& records);
/// Every opening that was ever seen, with its state and the evidence for it: open ones first.
std::string frontiers_html(const MissionRecords& records);
/// What was decided on places that look alike, in the order in which it was.
std::string loop_closures_html(const MissionMap& map);
/// Stops of the guard, orders, restarts, health.
std::string events_html(const MissionRecords& records);
/// Of each stage, as it was in effect.
std::string configuration_html(const LogInfo& log_info);

}  // namespace adit
