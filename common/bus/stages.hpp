// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace adit {

/// Every stage of the pipeline: the folders of procs/, the sections of the config file.
inline const std::vector<std::string>& stage_names() {
  static const std::vector<std::string> names{"scan_matching", "mapping"};
  return names;
}

}  // namespace adit
