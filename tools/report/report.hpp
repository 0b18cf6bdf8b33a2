// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace adit {

struct ReportOptions {
  std::vector<std::filesystem::path> logs;  ///< of one mission, in any order
  std::filesystem::path folder;             ///< created if it does not exist
  bool remap = false;  ///< build the map from laser scans and their matches, not from LOCAL_MAP
  /// For mission.html, which is left out without; see viewer_page().
  std::optional<std::string> viewer_page = {};
};

struct MissionReport {
  std::string outcome;   ///< one to three sentences
  std::string accuracy;  ///< against TRUTH, one line; empty without
  std::size_t scans = 0;
  double distance_travelled_m = 0.0;
  std::size_t page_bytes = 0;         ///< of mission.html
  std::vector<std::string> warnings;  ///< missing and skipped data, one sentence each
};

/// Called with the name of the current step and the finished share of it, 0 to 1.
using ReportProgress = std::function<void(const std::string& label, double done)>;

/// Writes the results of a mission from its logs: mission.html, map.png, map.pgm and map.yaml,
/// map.svg, graph.g2o, trajectory.tum (T_map_body), cloud.ply, volume.bt, junctions.geojson,
/// summary.json, run.lcmlog. A file without data in the log is left out, with a warning. The same
/// log gives the same files, byte for byte. The logs are streamed; memory holds the map, as in
/// mapping, and small pictures. Throws std::runtime_error if a log cannot be read, if no log has
/// data of a mission, or if a file cannot be written; the folder is unchanged then.
MissionReport write_report(const ReportOptions& options, const ReportProgress& progress = {});

}  // namespace adit
