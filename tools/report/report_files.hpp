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

/// What the files of a report are made of.
struct ReportInput {
  const MissionRecords& records;
  const MissionStatistics& statistics;
  const MapContent& map;
  const VolumeMap& volume;
  std::string title;
};

/// Writes all files of a report but the page and the log into a folder that is there. Gives a
/// sentence for each file for which there is nothing in the log. Throws std::runtime_error where
/// one cannot be written.
std::vector<std::string> write_report_files(const ReportInput& input,
                                            const std::filesystem::path& folder);

}  // namespace adit
