// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "common/path/planned_path.hpp"
#include "procs/planning/c_space.hpp"
#include "procs/planning/reachable.hpp"

namespace adit {

/// All that says why cells are lethal.
struct Grounds {
  const TerrainMap& terrain;
  const GroundLayers& layers;
  const CSpaceKernels& kernels;
  const Vehicle& vehicle;
  const GroundLimits& limits;
};

/// The cells that stop the robot where it got farthest: what is in the way of each drive on towards
/// the goal from the poses at the front of the region, ahead of these. Row by row, in odom.
std::vector<BlockingCell> blocking_cells(const Reachable& region, const Lattice& lattice,
                                         const GoalField& goals, const Grounds& grounds);

/// The cells that are in the way of standing at a pose. Row by row, in odom.
std::vector<BlockingCell> blocking_cells(const LatticePose& pose, const Lattice& lattice,
                                         const Grounds& grounds);

}  // namespace adit
