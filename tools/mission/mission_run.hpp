// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "common/bus/log/lcm_log.hpp"
#include "sim/live/world_choice.hpp"
#include "tools/mission/mission_progress.hpp"

namespace adit {

/// A mission in a simulated mine with all stages in this process, as fast as possible.
struct MissionRunOptions {
  WorldChoice world;
  std::filesystem::path folder;     ///< for run.lcmlog and journals; created if it does not exist
  std::filesystem::path config;     ///< YAML; empty: defaults, and the lasers of the simulator
  std::vector<std::string> faults;  ///< in the syntax of parse_fault
  /// Continues the mission in `folder`, in the same world, after a power loss: the simulated robot
  /// stands at its last TRUTH, and the log is the next one of the folder.
  bool resume = false;
  double time_max_s = 8.0 * 3600.0;  ///< of simulated time
  LogForm log_form = LogForm::kPlain;
};

struct MissionRunResult {
  MissionProgress last;
  double wall_s = 0.0;
  double distance_from_start_m =
      0.0;                  ///< straight-line distance of the true pose, in space, at the end
  double farthest_m = 0.0;  ///< maximum of that distance
  double distance_travelled_m = 0.0;  ///< true
  std::string failure;                ///< a collision; empty without
  std::string trace_failure;          ///< why phases.tsv could not be written; empty if it was
};

/// The same options give the same log, byte for byte. Throws for files that cannot be read or
/// written and worlds that cannot be built.
MissionRunResult run_mission(const MissionRunOptions& options,
                             const std::function<void(const MissionProgress&)>& progress = {});

}  // namespace adit
