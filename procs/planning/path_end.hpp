// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/path/planned_path.hpp"
#include "common/terrain/terrain_map.hpp"
#include "procs/planning/goal_field.hpp"
#include "procs/planning/heading_set.hpp"
#include "procs/planning/lattice.hpp"

namespace adit {

/// Ends a path along a route where there is room to go on: where nothing lethal is straight ahead
/// of its last pose within the width of the narrowest drift in which it turns into another (2.2 m).
/// Nearer to the outer wall of a bend what lies round its corner would be beside the vehicle, where
/// no laser looks, and no way on would be found. `seen` refuses what is lethal alone, as what lies
/// beyond a path was not seen. A path that would be too short to count ends 0.4 m before
/// what is lethal, as the pose at the end of a drive is not where it was planned; if need be so
/// much too short. Where not even that is to be had, in a narrow place, it stays as it is.
void end_with_room(PlannedPath& path, const TerrainMap& terrain, const HeadingSet& headings,
                   const Lattice& seen, const GoalField& goals, const Vehicle& vehicle);

}  // namespace adit
