// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace adit {

/// What all stages together need at the rates of the sensors.
struct StageLoad {
  double simulated_s = 0.0;  ///< of the mission that was measured
  double share = 0.0;        ///< time of a core that the stages needed, per second
  double share_max = 0.0;    ///< the same in the worst second of mission
  double log_mb_s = 0.0;     ///< of all messages
};

/// Begins a mission in a simulated mine with the robot of `config` (empty: the defaults), all
/// stages in this process, for `wall_s` of wall time after the robot began to move, and measures
/// the time in the stages, not in the simulator. Journals are written to `folder`. Throws as
/// run_mission().
StageLoad measure_stage_load(const std::filesystem::path& config,
                             const std::filesystem::path& folder, double wall_s);

}  // namespace adit
