// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "common/sensing/laser_mount.hpp"
#include "procs/mapping/mapping.hpp"

namespace adit {

/// A run to be merged: its map, and the lasers of its robot.
struct MergeInput {
  std::string name;  ///< as given
  StoredMap map;
  Lasers lasers;
  std::vector<std::string> warnings;  ///< one sentence each
};

/// Opens a run: a folder with map.journal (`adit map`) or mapping.journal (a mission), or a log,
/// which `adit map` maps in `scratch` with the configuration `config` (may be empty). The lasers
/// are those of the configuration, else those recorded in the folder's logs. Throws
/// std::runtime_error if there is no map.
MergeInput open_run(const std::filesystem::path& run, const std::filesystem::path& config,
                    const std::filesystem::path& scratch,
                    const std::function<void(const std::string&, double)>& progress);

}  // namespace adit
