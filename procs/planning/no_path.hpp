// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "common/types/planned_path.hpp"
#include "common/types/terrain_map.hpp"
#include "common/types/vehicle.hpp"
#include "procs/planning/c_space/c_space.hpp"
#include "procs/planning/goals/goal_field.hpp"
#include "procs/planning/lattice/lattice.hpp"

namespace adit {

/// The maps of a search that found no path.
struct NoPathContext {
  const TerrainMap& terrain;
  const Pose2& T_level_body;
  const GroundLayers& layers;
  const CSpaceKernels& kernels;
  const Vehicle& vehicle;
  const CSpaceParams& c_space;
};

/// Why there is no path, as a PlannedPath without points, and how far the robot can get.
struct NoPathExplanation {
  PlannedPath path;  ///< outcome, reason, progress and blocking cells
  /// For each cell of the terrain map, 1 where the centre of the robot can get; empty if the start
  /// pose is blocked.
  std::vector<std::uint8_t> reached;
};

/// Explains a search in `lattice` that ended without a path:
/// - kStartBlocked: the start pose is not on the map or blocked;
/// - kUnknown: a path may lead over unobserved ground ahead, or below a roof that no scan shows;
/// - kNarrow: the robot passes if all margins are removed;
/// - kBlocked: observed obstacles block the robot.
/// The evidence is the cells that block it at the front of the reachable region.
NoPathExplanation explain_no_path(const Lattice& lattice, const LatticePose& start,
                                  const GoalField& goals, const NoPathContext& context);

}  // namespace adit
