// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace adit {

struct MapRunOptions {
  std::filesystem::path input;   ///< CARMEN log, plain or gzip, or LCM log
  std::filesystem::path folder;  ///< made if it is not there
  std::filesystem::path config;  ///< YAML, or empty: defaults
  bool use_odometry = true;      ///< otherwise wheel odometry and IMU are left out
  std::filesystem::path resume;  ///< folder of an earlier run whose map is continued, or empty
  bool draw_graph = false;       ///< draw the pose graph into map.png
};

struct MapRunResult {
  std::size_t scans = 0;
  std::size_t lost = 0;
  double path_length_m = 0.0;
  std::size_t local_maps = 0;     ///< of the whole map
  std::size_t loop_closures = 0;  ///< in force at the end
  std::size_t cross_session_loop_closures =
      0;  ///< those of them that hold this run to the map that it continues
  double wall_s = 0.0;
  std::vector<std::string> warnings;  ///< what was skipped or could not be done, a sentence each
};

/// Runs the pipeline on a recording in this process, as fast as it goes, and writes trajectory.tum
/// (T_map_body), odometry.tum (T_odom_body), map.png, map.pgm + map.yaml, graph.g2o,
/// associations.tsv, map.journal (what mapping knows, to be resumed), run.lcmlog (all messages, in
/// and out) and summary.json. The same log, config and build give the same files but for the times
/// in summary.json, byte for byte. A map that is resumed keeps its frame, and its files come to
/// show both runs; the folders may be one and the same. `progress` is called with what is being
/// done and the share of it that is done. Throws ConfigError or std::runtime_error; the folder is
/// then as it was.
MapRunResult run_map(const MapRunOptions& options,
                     const std::function<void(const std::string& label, double done)>& progress);

}  // namespace adit
