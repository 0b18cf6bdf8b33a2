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
#include "procs/planning/passage/wall_distance.hpp"

namespace adit {

/// The points of a lattice path, about `spacing_m` apart, with curvature, clearance and cost. At a
/// change of direction there are two points: the end of one part and the start of the next. The
/// clearance is the distance from the outline to lethal ground under the body, or from the wheels
/// to lethal ground under the wheels, whichever is smaller, at most 5 m.
std::vector<PathPoint> path_points(const LatticePath& path, const LatticePose& start,
                                   const MotionPrimitives& primitives, const HeadingSet& headings,
                                   const TerrainMap& terrain, const GroundLayers& layers,
                                   const Vehicle& vehicle, double spacing_m);

/// The clearance that a drive needs to know, at the resolution of CellParts: cells that a wall
/// blocks with the regions that overlap it reach up to 0.2 m farther than the wall. Points with
/// more clearance than `enough_m` stay as they are, others are never reduced.
void refine_clearance(PlannedPath& path, double enough_m, const TerrainMap& terrain,
                      const GroundLayers& layers, const WallDistance& walls,
                      const Vehicle& vehicle);

/// Shortens a path along a route so that the robot can continue from its end: nothing lethal lies
/// straight ahead of its last pose within the width of the narrowest tunnel in which the vehicle
/// turns into another one (2.2 m by default). Closer to the outer wall of a bend, the continuation
/// around the corner would lie beside the vehicle, which no laser scans. `lattice` must treat only
/// lethal ground as blocked, since the ground beyond a path is unobserved.
///
/// If such a path would be shorter than the minimum progress, the path ends 0.4 m before lethal
/// ground instead, as a drive may end beyond its planned end; it may then fall short of the minimum
/// progress by as much. If that is impossible too, in a narrow place, the path is unchanged.
void trim_to_clear_end(PlannedPath& path, const TerrainMap& terrain, const HeadingSet& headings,
                       const Lattice& lattice, const GoalField& goals, const Vehicle& vehicle);

}  // namespace adit
