// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "tools/report/mission_statistics.hpp"
#include "tools/report/svg/map_svg.hpp"

namespace adit {

/// The page of a mission, HTML 5 with everything in it: nothing is asked of any network. `notes`
/// are said at its head: what the log lacks, a sentence each.
std::string mission_page(const MissionRecords& records, const MissionStatistics& statistics,
                         const MapContent& map, const std::string& title,
                         const std::vector<std::string>& notes);

}  // namespace adit
