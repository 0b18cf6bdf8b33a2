// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "procs/volume_map/volume_map.hpp"
#include "tools/report/mission_statistics.hpp"
#include "tools/report/svg/map_svg.hpp"

namespace adit {

/// Input of the files of a report.
struct ReportInput {
  const MissionRecords& records;
  const MissionStatistics& statistics;
  const MapContent& map;
  const VolumeMap& volume;
  std::string title;
};

/// Writes all files of a report except mission.html and run.lcmlog into an existing folder. Returns
/// a warning for each file without data in the log. Throws std::runtime_error if a file cannot be
/// written.
std::vector<std::string> write_report_files(const ReportInput& input,
                                            const std::filesystem::path& folder);

}  // namespace adit
