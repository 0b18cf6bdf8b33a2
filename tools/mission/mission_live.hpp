// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/bus/log/lcm_log.hpp"
#include "sim/live/world_choice.hpp"
#include "tools/mission/mission_progress.hpp"

namespace adit {

/// A mission in a simulated mine. Each stage is a process under adit-supervisor, on a private
/// network.
struct MissionLiveOptions {
  WorldChoice world;                 ///< not used with `resume`
  std::filesystem::path folder;      ///< created if it does not exist; see MissionFolder
  bool resume = false;               ///< resume the mission in the folder
  std::filesystem::path config;      ///< YAML; empty: defaults, and the lasers of the simulator
  std::string speed = "max";         ///< multiple of real time, or max
  std::vector<std::string> faults;   ///< in the syntax of parse_fault
  double time_max_s = 8.0 * 3600.0;  ///< of simulated time
  LogForm log_form = LogForm::kPlain;
  /// A socket that listens in the network of the user, on which adit-viewer serves the mission.
  std::optional<int> view_socket = {};
};

struct MissionLiveResult {
  MissionProgress last;
  double wall_s = 0.0;
  double farthest_m = 0.0;    ///< largest straight-line distance of the true pose from the start
  bool interrupted = false;   ///< by SIGINT or SIGTERM
  std::string abort_reason;   ///< empty if the mission ended by itself
  std::string trace_failure;  ///< why phases.tsv could not be written; empty if it was
};

/// `wall_s` is the wall time since the start of the mission.
using MissionLiveProgress = std::function<void(const MissionProgress&, double wall_s)>;

/// Runs a mission until PHASE is ended, the simulation fails, the time limit is reached, or SIGINT
/// or SIGTERM is received, and stops all processes. `notify` receives messages for the operator.
/// Throws for files that cannot be read or written, worlds that cannot be built, and processes that
/// cannot be started. Changes the working folder and the network of this process.
MissionLiveResult run_live_mission(const MissionLiveOptions& options,
                                   const MissionLiveProgress& progress,
                                   const std::function<void(const std::string&)>& notify);

}  // namespace adit
