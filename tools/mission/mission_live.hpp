// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/live/world_choice.hpp"
#include "tools/mission/mission_progress.hpp"

namespace adit {

/// A mission in a simulated mine, each stage a process under an adit-supervisor, on a network of
/// their own.
struct MissionLiveOptions {
  WorldChoice world;                 ///< not read where it goes on
  std::filesystem::path folder;      ///< made if it is not there; see MissionFolder
  bool resume = false;               ///< go on with the mission in the folder
  std::filesystem::path config;      ///< YAML; empty: defaults, and the lasers of the simulator
  std::string speed = "max";         ///< times real time, or max
  std::vector<std::string> faults;   ///< as parse_fault takes them
  double time_max_s = 8.0 * 3600.0;  ///< of simulated time
};

struct MissionLiveResult {
  MissionProgress last;
  double wall_s = 0.0;
  double farthest_m = 0.0;   ///< of the true body from the start, straight
  bool interrupted = false;  ///< by SIGINT or SIGTERM
  std::string abort_reason;  ///< why it did not come to its end; empty if it did
};

/// Wall time since the mission began [s].
using MissionLiveProgress = std::function<void(const MissionProgress&, double wall_s)>;

/// Until PHASE says ended, the run fails, its time is up, or SIGINT or SIGTERM comes; nothing is
/// left running. `say` takes what a person should know. Throws for what cannot be read, built,
/// written or started. Changes the working folder and the network of this process.
MissionLiveResult run_live_mission(const MissionLiveOptions& options,
                                   const MissionLiveProgress& progress,
                                   const std::function<void(const std::string&)>& notify);

}  // namespace adit
