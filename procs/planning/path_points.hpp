// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "common/types/planned_path.hpp"
#include "common/types/terrain_map.hpp"
#include "common/types/vehicle.hpp"
#include "procs/planning/c_space/ground_layers.hpp"
#include "procs/planning/c_space/heading_set.hpp"
#include "procs/planning/goals/goal_field.hpp"
#include "procs/planning/lattice/lattice.hpp"
#include "procs/planning/lattice/lattice_search.hpp"
#include "procs/planning/lattice/motion_primitives.hpp"

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

/// Ends a path along a route where there is room to go on: where nothing lethal is straight ahead
/// of its last pose within the width of the narrowest drift in which it turns into another (2.2 m).
/// Nearer to the outer wall of a bend what lies round its corner would be beside the vehicle, where
/// no laser looks, and no way on would be found. `seen` refuses what is lethal alone, as what lies
/// beyond a path was not seen. A path that would be too short to count ends 0.4 m before
/// what is lethal, as the pose at the end of a drive is not where it was planned; if need be so
/// much too short. Where not even that is to be had, in a narrow place, it stays as it is.
void trim_to_clear_end(PlannedPath& path, const TerrainMap& terrain, const HeadingSet& headings,
                       const Lattice& seen, const GoalField& goals, const Vehicle& vehicle);

}  // namespace adit
