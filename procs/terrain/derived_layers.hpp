// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/types/terrain_map.hpp"
#include "procs/terrain/terrain_params.hpp"

namespace adit {

/// Sets slope and step of the cells whose ground is seen, from the heights of the ground around: a
/// plane through 5 × 5 cells (least squares), and the 8 neighbours. NaN where fewer than
/// 21 of the 25 are seen, or no neighbour is.
void set_slope_and_step(TerrainMap& map);

/// Sets the repulsion of all cells: the coefficients convolved with a cone, which is 1 in its
/// middle and 0 at the radius (the paper's section 3.1: a narrow radial kernel that serves as a
/// repellent potential field), scaled so that a straight wall of one coefficient repels with that
/// at its foot. Coefficients that are not known, or below the least, do not repel.
void set_repulsion(TerrainMap& map, const RepulsionParams& params);

}  // namespace adit
