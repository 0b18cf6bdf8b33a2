// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "tools/mission/mission_folder.hpp"
#include "tools/mission/mission_live.hpp"

namespace adit {

/// Start options of the simulator of a mission.
struct SimulatorStart {
  std::filesystem::path log;                ///< file to record
  std::optional<std::int64_t> start_utime;  ///< of simulated time; nothing: the wall clock
  std::string speed = "max";                ///< value of `adit sim --speed`
  std::vector<std::string> faults;          ///< in the syntax of parse_fault
};

/// YAML for all processes of a mission: all keys of all stages with their effective values.
/// Journals have no folder, because the processes run in the folder of the mission. Throws
/// ConfigError.
std::string mission_config(const std::filesystem::path& config);

/// The process list: the stages, and the simulator, which waits for all stages and records.
std::string process_list_text(const SimulatorStart& start);

/// YAML for adit-supervisor.
std::string supervisor_config();

/// Joins YAML texts. Of sections with the same name the first one is used.
std::string without_repeated_sections(const std::vector<std::string>& yamls);

/// Writes all input files of the processes of a mission into its folder. A resumed mission keeps
/// its configuration, and the simulated robot starts at the last TRUTH. Returns the position of the
/// first start in world [m]. Throws for invalid options, and as MissionFolder does.
Eigen::Vector2d prepare_mission(const MissionLiveOptions& options, const MissionFolder& folder);

}  // namespace adit
