// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/types/cloud.hpp"
#include "common/types/terrain_map.hpp"
#include "common/types/vehicle.hpp"

namespace adit {

/// Sets TerrainCell::obstacle_parts of the observed cells: the parts in which points of the cloud
/// lie higher above the ground of the cell than ground may be rough, and lower than the roof that
/// the vehicle needs. Regions of 3 × 3 cells enlarge an obstacle by a cell and their cells by up to
/// another; its parts are exact within 1/8 of a cell, so that a gap keeps its width.
void set_obstacle_parts(TerrainMap& map, const Cloud& cloud, const Vehicle& vehicle);

}  // namespace adit
