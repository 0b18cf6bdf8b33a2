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
  std::filesystem::path folder;  ///< created if it does not exist
  std::filesystem::path config;  ///< YAML, or empty: defaults
};

struct VolumeRunResult {
  int scans = 0;
  std::size_t volumes = 0;
  std::size_t points = 0;             ///< in cloud.ply
  std::vector<std::string> warnings;  ///< one sentence each
};

/// Replays a log to the stage volume_map and writes volume.bt, volume.ot and cloud.ply. Throws
/// std::runtime_error if the log cannot be read or has no 3D scan, or if a file cannot be written;
/// the folder is unchanged then.
VolumeRunResult run_volume(const VolumeRunOptions& options,
                           const std::function<void(double)>& progress = {});

}  // namespace adit
