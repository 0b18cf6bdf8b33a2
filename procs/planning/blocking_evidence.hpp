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

/// Where a robot can get to, and how far towards the goal.
struct ReachableRegion {
  std::vector<LatticePose> poses;  ///< in order of discovery
  double progress_m = 0.0;         ///< the greatest of those where a path may end, not less than 0
};

/// All that can be reached from a pose, at any cost, or as much as it takes to make a progress of
/// `enough_m`. Empty where the robot cannot stand.
ReachableRegion reachable_region(const Lattice& lattice, const LatticePose& start,
                                 const GoalField& goals,
                                 double enough_m = std::numeric_limits<double>::infinity());

/// All that says why cells are lethal.
struct EvidenceContext {
  const TerrainMap& terrain;
  const GroundLayers& layers;
  const CSpaceKernels& kernels;
  const Vehicle& vehicle;
  const GroundLimits& limits;
};

/// The cells that stop the robot where it got farthest: what is in the way of each drive on towards
/// the goal from the poses at the front of the region, ahead of these. Row by row, in odom.
std::vector<BlockingCell> blocking_cells(const ReachableRegion& region, const Lattice& lattice,
                                         const GoalField& goals, const EvidenceContext& context);

/// The cells that are in the way of standing at a pose. Row by row, in odom.
std::vector<BlockingCell> blocking_cells(const LatticePose& pose, const Lattice& lattice,
                                         const EvidenceContext& context);

}  // namespace adit
