// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "common/records/hazard.hpp"
#include "common/types/terrain_map.hpp"
#include "common/types/vehicle.hpp"

namespace adit {

/// What the 3D scan `number` shows of hazards. `z_m`: height of odom there.
/// - water: ground without returns over more than the strip outside of a portal that has none.
/// - drop: ground, or a beam that passed over ground, that lies lower by 0.3 m than ground beside
/// it
///   that the robot can reach; its value is the depth that was seen. Beams that merely passed over
///   ground are none: a rail, a crest or a sill hides ground too.
/// - low roof: roof over drivable ground that is too low for the vehicle.
std::vector<Hazard> hazards_of(const TerrainMap& terrain, int number, double z_m,
                               const Vehicle& vehicle);

}  // namespace adit
