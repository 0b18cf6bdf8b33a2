// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace adit {

struct CloudSequenceImport {
  std::size_t clouds = 0;
  std::size_t points = 0;
  std::vector<std::string> skipped;   ///< files that cannot be read, without a verb
  std::vector<std::string> warnings;  ///< sentences
};

/// Whether the folder has point clouds: files .pcd, .ply or .xyz.
bool is_cloud_folder(const std::filesystem::path& folder);

/// Converts point clouds in the frame of a level body, one file for each, to an LCM log: CLOUD, and
/// the level slice on LASER_FRONT, in the order of the names. The time of a file is its name if
/// that is a number (seconds, or ns), else that of its pose, else they are 0.1 s apart. `poses`: a
/// TUM file with the poses of the body, or empty: all are at the origin. Throws std::runtime_error
/// if no file can be read, or if times and poses do not fit the files; then there is no log.
CloudSequenceImport import_cloud_sequence(const std::filesystem::path& folder,
                                          const std::filesystem::path& lcm_log,
                                          const std::filesystem::path& poses,
                                          const std::function<void(double)>& progress);

}  // namespace adit
