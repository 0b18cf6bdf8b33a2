// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace adit {

struct ReportOptions {
  std::vector<std::filesystem::path> logs;  ///< of one mission, in order of time
  std::filesystem::path folder;             ///< made if it is not there
  bool remap = false;  ///< map anew from laser scans and their matches, whatever map is in the log
};

struct MissionReport {
  std::string outcome;  ///< how the mission went, a sentence or a few
  std::size_t scans = 0;
  double distance_travelled_m = 0.0;
  std::size_t page_bytes = 0;         ///< of mission.html
  std::vector<std::string> warnings;  ///< what the log lacks or what was skipped, a sentence each
};

/// Called with what is being done and the share of it that is done, 0 to 1.
using ReportProgress = std::function<void(const std::string& label, double done)>;

/// Makes the folder of a mission from what was recorded of it: mission.html, map.png, map.pgm and
/// map.yaml, map.svg, graph.g2o, trajectory.tum (T_map_body), cloud.ply, volume.bt,
/// junctions.geojson, summary.json, run.lcmlog. What the log does not hold is left out, and said.
/// The same log gives the same files, byte for byte. A file of the log is taken as it goes; what is
/// held in memory is the map, as mapping holds it, and small pictures. Throws std::runtime_error
/// where a log cannot be read or holds nothing of a mission, or a file cannot be written; then the
/// folder is as it was.
MissionReport write_report(const ReportOptions& options, const ReportProgress& progress = {});

}  // namespace adit
