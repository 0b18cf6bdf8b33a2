// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/terrain/terrain_map.hpp"
#include "common/vehicle/vehicle.hpp"
#include "procs/planning/c_space.hpp"
#include "procs/planning/lattice.hpp"

namespace adit {

/// The pose of the lattice nearest to one in level; outside of the map if that is.
LatticePose nearest_pose(const TerrainMap& terrain, const HeadingSet& headings,
                         const Pose2& T_level_body);

/// A robot beside an obstacle may stand where the conservative kernels forbid it: around the start,
/// poses are allowed that only their margin makes lethal, at the cost of ground at the limit, so
/// that the robot can leave. The rectangles of the vehicle itself stay clear of what is lethal, but
/// for half a cell: the pose of the lattice is that far from the robot, and regions of the terrain
/// make things wider by a whole one.
void allow_leaving(CSpace& space, const LatticePose& start, const GroundLayers& layers,
                   const CSpaceKernels& kernels, std::uint16_t cost);

}  // namespace adit
