// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "common/types/planned_path.hpp"
#include "common/types/terrain_map.hpp"
#include "procs/planning/planning.hpp"
#include "tests/support/scores/path_feasibility.hpp"
#include "tests/support/worlds/random_corridor.hpp"

namespace adit {

/// What a robot made of its corridor by one look at it, and what is true of the path.
struct CorridorRun {
  TerrainMap terrain;
  PlannedPath path;
  std::optional<FeasibilityFault> fault;  ///< of the true vehicle on the path
  double along_m = 0.0;                   ///< the drift that the end of the path lies ahead
  double terrain_ms = 0.0;                ///< of the time of this thread
  double plan_ms = 0.0;

  [[nodiscard]] bool found() const { return path.outcome == PlanOutcome::kFound; }
};

/// From a tilt of the front laser (`seed` of its noise) to a path of up to 10 m.
CorridorRun run_corridor(const Corridor& corridor, const std::string& estimator, std::uint64_t seed,
                         Planning& planning);

}  // namespace adit
