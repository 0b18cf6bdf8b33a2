// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/config/config_file.hpp"
#include "common/types/cloud.hpp"

namespace adit {

/// The 3D scans of a log or point cloud.
struct ScanInput {
  std::vector<Cloud> clouds;
  std::vector<std::string> warnings;  ///< skipped data and assumptions, one text each
};

/// Selection among the scans of a log. By default the first complete scan.
struct ScanChoice {
  std::optional<int> number = std::nullopt;  ///< in log order, from 1
  std::optional<int> id = std::nullopt;
  bool all = false;
};

/// Reads the clouds of a log (channel CLOUD). If it has none, runs scan assembly on its scan
/// requests, laser scans, tilts and poses, with the laser poses of the configuration, else of the
/// log (channel CONFIG). Throws std::runtime_error with the missing channels if there is no scan.
ScanInput scans_of_log(const std::filesystem::path& file, const ConfigFile& config);

/// A scan with its number in the log, from 1.
struct NumberedScan {
  int number = 1;
  Cloud cloud;
};

/// Returns the selected scans. Throws std::runtime_error if the selection does not exist.
std::vector<NumberedScan> select_scans(const ScanInput& source, const ScanChoice& choice);

}  // namespace adit
