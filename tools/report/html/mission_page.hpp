// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "tools/report/mission_statistics.hpp"
#include "tools/report/svg/map_svg.hpp"

namespace adit {

/// The page of a mission: page.html with its placeholders filled. HTML 5 in one file, which loads
/// nothing else. `warnings` are shown in its header, one sentence each.
std::string mission_page(const MissionRecords& records, const MissionStatistics& statistics,
                         const MapContent& map, const std::string& title,
                         const std::vector<std::string>& warnings);

/// Intervals of each phase and of stops on a common time axis, and as a table, as HTML.
std::string timeline_html(const MissionRecords& records, const MissionStatistics& statistics);

/// A legend and one card for each 3D scan, as HTML.
std::string scan_cards_html(const MissionRecords& records, const MissionMap& map);

/// Marks of the scans on the map. Scans without a pose on the map are left out.
std::vector<ScanMark> scan_marks(const MissionRecords& records, const MissionMap& map);

}  // namespace adit
