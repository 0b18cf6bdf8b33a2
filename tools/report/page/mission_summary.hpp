// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "tools/report/mission_statistics.hpp"
#include "tools/report/page/blockages.hpp"

namespace adit {

/// What a mission shows, one line: how it ended, what was explored, and what was seen or is unknown
/// behind what blocked the robot.
std::string headline(const MissionStatistics& statistics, const std::vector<Blockage>& blockages);

/// The message of the topic /summary (viewer/README.md), JSON.
std::string summary_message(const MissionRecords& records, const MissionStatistics& statistics,
                            const std::vector<Blockage>& blockages,
                            const std::vector<std::string>& warnings);

}  // namespace adit
