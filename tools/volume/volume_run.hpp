// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace adit {

struct VolumeRunOptions {
  std::filesystem::path input;   ///< LCM log with CLOUD, POSE_GRAPH and MAP_CORRECTION
  std::filesystem::path folder;  ///< made if it is not there
  std::filesystem::path config;  ///< YAML, or empty: defaults
};

struct VolumeRunResult {
  int scans = 0;
  std::size_t volumes = 0;
  std::size_t points = 0;             ///< in cloud.ply
  std::vector<std::string> warnings;  ///< what was wrong with the log, a sentence each
};

/// Plays a log to the stage volume_map and writes volume.bt, volume.ot and cloud.ply. Throws
/// std::runtime_error where the log cannot be used or has no 3D scan, or a file cannot be written;
/// then the folder is as it was.
VolumeRunResult run_volume(const VolumeRunOptions& options,
                           const std::function<void(double)>& progress = {});

}  // namespace adit
