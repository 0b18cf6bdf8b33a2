// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "tools/report/mission_statistics.hpp"

namespace adit {

// Sections of the page of a mission, as HTML.

/// The main figures; the other figures in a closed <details>.
std::string metrics_html(const MissionStatistics& statistics, const MissionRecords& records);
/// Intervals of each phase and of stops on a common time axis, and as a table.
std::string timeline_html(const MissionRecords& records, const MissionStatistics& statistics);
/// All frontiers with state and evidence, open ones first.
std::string frontiers_html(const MissionRecords& records);
/// Decisions of data association, in order of time.
std::string loop_closures_html(const MissionMap& map);
/// Stops, orders, restarts, health and driving failures.
std::string events_html(const MissionRecords& records);
/// CONFIG of each stage, and the number of messages per channel.
std::string configuration_html(const LogInfo& log_info);

}  // namespace adit
