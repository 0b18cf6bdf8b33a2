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

/// How the simulator of a mission is to be started.
struct SimulatorStart {
  std::filesystem::path log;                ///< that it is to write
  std::optional<std::int64_t> start_utime;  ///< of simulated time; the wall clock's without
  std::string speed = "max";                ///< as `adit sim --speed` takes it
  std::vector<std::string> faults;          ///< as parse_fault takes them
};

/// One file for all processes of a mission: every key of every stage with the value in effect.
/// Journals are named without a folder, for processes that run in that of the mission. Throws
/// ConfigError.
std::string mission_config(const std::filesystem::path& config);

/// The process list: the simulator, which waits for all stages and records, and the stages.
std::string process_list_text(const SimulatorStart& start);

/// The file of adit-supervisor.
std::string supervisor_config();

/// The sections of several YAML texts, each as where it comes first.
std::string without_repeated_sections(const std::vector<std::string>& yamls);

/// Writes into the folder what all processes of a mission read. One that goes on keeps its
/// configuration, and the simulated robot stands where TRUTH last had it. Returns where it once
/// began, in world [m]. Throws for options that cannot be used, and as MissionFolder does.
Eigen::Vector2d prepare_mission(const MissionLiveOptions& options, const MissionFolder& folder);

}  // namespace adit
