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
};

struct MapRunResult {
  std::size_t scans = 0;
  std::size_t lost = 0;
  double path_length_m = 0.0;
  double wall_s = 0.0;
  std::vector<std::string> complaints;  ///< what was skipped or could not be done, a sentence each
};

/// Runs the pipeline on a recording in this process, as fast as it goes, and writes trajectory.tum,
/// map.png, map.pgm + map.yaml, run.lcmlog (all messages, in and out) and summary.json. The same
/// log, config and build give the same trajectory.tum and run.lcmlog, byte for byte. `progress` is
/// called with what is being done and the share of it that is done. Throws ConfigError or
/// std::runtime_error; the folder is then as it was.
MapRunResult run_map(const MapRunOptions& options,
                     const std::function<void(const std::string& label, double done)>& progress);

}  // namespace adit
