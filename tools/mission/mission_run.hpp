// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "sim/live/world_choice.hpp"
#include "tools/mission/mission_progress.hpp"

namespace adit {

/// A mission in a simulated mine, all stages in this process, as fast as it goes.
struct MissionRunOptions {
  WorldChoice world;
  std::filesystem::path folder;      ///< made if it is not there; run.lcmlog and journals go there
  std::filesystem::path config;      ///< YAML; empty: defaults, and the lasers of the simulator
  std::vector<std::string> faults;   ///< as parse_fault takes them
  double time_max_s = 8.0 * 3600.0;  ///< of simulated time
};

struct MissionRunResult {
  MissionProgress last;
  double wall_s = 0.0;
  double distance_from_start_m = 0.0;  ///< of the true body from the start, at the end
  double farthest_m = 0.0;             ///< of the true body from the start, straight
  double distance_travelled_m = 0.0;   ///< true
  double rmse_m = 0.0;  ///< of T_map_body against the truth, as it was believed at the time
  std::string failure;  ///< why the simulated run failed: a collision; empty if it did not
};

/// The same options give the same log, byte for byte. Throws for what cannot be read, built or
/// written.
MissionRunResult run_mission(const MissionRunOptions& options,
                             const std::function<void(const MissionProgress&)>& progress = {});

}  // namespace adit
