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

/// What a file holds of 3D scans.
struct ScanInput {
  std::vector<Cloud> clouds;
  std::vector<std::string> warnings;  ///< what was skipped or taken for granted, a sentence each
};

/// Which of the scans of a log. Without any of these, the first that is complete.
struct ScanChoice {
  std::optional<int> number = std::nullopt;  ///< in the order of the log, from 1
  std::optional<int> id = std::nullopt;
  bool all = false;
};

/// Whether the file is an LCM log, by its first bytes or its name.
bool is_scan_log(const std::filesystem::path& file);

/// The clouds of a log (channel CLOUD); of a log without any, those that scan assembly makes of its
/// scan requests, laser scans, tilts and poses. The lasers are where the config says, or else
/// the log itself. Throws std::runtime_error where there is none, and says what is missing.
ScanInput scans_of_log(const std::filesystem::path& file, const ConfigFile& config);

/// A scan with its number, from 1.
struct NumberedScan {
  int number = 1;
  Cloud cloud;
};

/// Throws std::runtime_error where there is no such scan.
std::vector<NumberedScan> select_scans(const ScanInput& source, const ScanChoice& choice);

}  // namespace adit
