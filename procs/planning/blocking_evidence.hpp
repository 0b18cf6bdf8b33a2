// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <vector>

#include "common/types/planned_path.hpp"
#include "procs/planning/c_space/c_space.hpp"
#include "procs/planning/goals/goal_field.hpp"
#include "procs/planning/lattice/lattice.hpp"

namespace adit {

/// The poses that the robot can reach, and how far towards the goal.
struct ReachableRegion {
  std::vector<LatticePose> poses;  ///< in order of discovery
  double progress_m = 0.0;         ///< maximum over poses at which a path may end; at least 0
};

/// All poses that can be reached from a start pose at any cost. The search stops at a progress of
/// `enough_m`. Empty if the start pose is blocked.
ReachableRegion reachable_region(const Lattice& lattice, const LatticePose& start,
                                 const GoalField& goals,
                                 double enough_m = std::numeric_limits<double>::infinity());

/// The maps that state why cells are lethal.
struct EvidenceContext {
  const TerrainMap& terrain;
  const GroundLayers& layers;
  const CSpaceKernels& kernels;
  const Vehicle& vehicle;
  const GroundLimits& limits;
};

/// The cells that block the robot at the front of the region: for each pose at the front, the cells
/// that block its primitives towards the goal and lie ahead of it. Row by row, in odom.
std::vector<BlockingCell> blocking_cells(const ReachableRegion& region, const Lattice& lattice,
                                         const GoalField& goals, const EvidenceContext& context);

/// The cells that block a pose. Row by row, in odom.
std::vector<BlockingCell> blocking_cells(const LatticePose& pose, const Lattice& lattice,
                                         const EvidenceContext& context);

}  // namespace adit
