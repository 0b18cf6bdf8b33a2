// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "common/bus/order_seal.hpp"
#include "common/sensing/laser_mount.hpp"
#include "common/types/vehicle.hpp"

namespace adit {

/// All stages of the pipeline: the folders of procs/.
inline const std::vector<std::string>& stage_names() {
  static const std::vector<std::string> names{
      "scan_matching", "mapping", "scan_assembly", "terrain", "volume_map", "planning",
      "driving",       "guard",   "exploration",   "mission", "supervisor"};
  return names;
}

/// The section of the simulator, which runs like a stage but is not one.
inline constexpr const char* kSimSection = "sim";
/// The section of the viewer, a process that is not a stage.
inline constexpr const char* kViewerSection = "viewer";

/// All sections of the configuration file: those of the stages, the shared ones, the simulator's
/// and the viewer's.
inline std::vector<std::string> config_sections() {
  std::vector<std::string> names = stage_names();
  names.emplace_back(Lasers::kSection);
  names.emplace_back(Vehicle::kSection);
  names.emplace_back(SealParams::kSection);
  names.emplace_back(kSimSection);
  names.emplace_back(kViewerSection);
  return names;
}

}  // namespace adit
