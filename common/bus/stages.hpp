// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "common/sensing/laser_mount.hpp"

namespace adit {

/// Every stage of the pipeline: the folders of procs/.
inline const std::vector<std::string>& stage_names() {
  static const std::vector<std::string> names{"scan_matching", "mapping"};
  return names;
}

/// All sections of the config file that belong to stages: one for each, and those that they share.
inline std::vector<std::string> config_sections() {
  std::vector<std::string> names = stage_names();
  names.emplace_back(Lasers::kSection);
  return names;
}

}  // namespace adit
