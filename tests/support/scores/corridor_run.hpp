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

/// Terrain map and path from one 3D scan of a corridor, and the check of the path by ground truth.
struct CorridorRun {
  TerrainMap terrain;
  PlannedPath path;
  std::optional<FeasibilityFault> fault;  ///< first fault of the true vehicle on the path
  double along_m = 0.0;                   ///< progress along the tunnel at the end of the path
  double terrain_ms = 0.0;                ///< CPU time of this thread
  double plan_ms = 0.0;                   ///< CPU time of this thread

  [[nodiscard]] bool found() const { return path.outcome == PlanOutcome::kFound; }
};

/// Simulates one tilt sweep of the front laser (`seed` of its noise), makes the terrain map with an
/// estimator (`terrain.estimator.kind`) and plans a path of up to 10 m along the tunnel.
CorridorRun run_corridor(const Corridor& corridor, const std::string& estimator, std::uint64_t seed,
                         Planning& planning);

}  // namespace adit
