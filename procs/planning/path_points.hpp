// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "common/path/planned_path.hpp"
#include "common/terrain/terrain_map.hpp"
#include "common/vehicle/vehicle.hpp"
#include "procs/planning/ground_layers.hpp"
#include "procs/planning/lattice_search.hpp"
#include "procs/planning/motion_primitives.hpp"

namespace adit {

/// From the robot's outline at a pose in level to what is lethal under it, or from its wheels to
/// what is lethal under them, whichever is nearer [m]; never more than `most_m`.
double clearance(const Pose2& T_level_body, const Vehicle& vehicle, const GroundLayers& layers,
                 const TerrainMap& terrain, double most_m = 5.0);

/// The points of a path, about `spacing_m` apart. A change of direction of travel is a point twice:
/// as the end of the one and the beginning of the other.
std::vector<PathPoint> path_points(const LatticePath& path, const LatticePose& start,
                                   const MotionPrimitives& primitives, const HeadingSet& headings,
                                   const TerrainMap& terrain, const GroundLayers& layers,
                                   const Vehicle& vehicle, double spacing_m);

}  // namespace adit
