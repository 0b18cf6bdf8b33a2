// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/types/terrain_map.hpp"
#include "procs/terrain/terrain_params.hpp"

namespace adit {

/// Sets slope and step of the observed cells from the ground around them: the slope of a
/// least-squares plane through 9 × 9 cells, and the largest height difference to the 8 neighbours,
/// relative to the trend of the ground.
/// NaN if fewer than 55 of the 81 cells, or no neighbour, are observed.
void set_slope_and_step(TerrainMap& map);

/// Sets the repulsion of all cells: the coefficients convolved with a cone of value 1 at its centre
/// and 0 at the radius (paper, section 3.1: a narrow radial kernel that serves as a repellent
/// potential field), scaled so that a straight wall of constant coefficient has that repulsion at
/// its foot. Unknown coefficients, and those below the minimum, do not repel.
void set_repulsion(TerrainMap& map, const RepulsionParams& params);

}  // namespace adit
