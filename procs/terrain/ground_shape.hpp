// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/terrain/terrain_map.hpp"

namespace adit {

/// Sets slope and step of the cells whose ground is seen, from the heights of the ground around: a
/// plane through 5 × 5 cells (least squares), and the 8 neighbours. NaN where fewer than 20 of
/// the 25 are seen, or no neighbour is.
void set_slope_and_step(TerrainMap& map);

}  // namespace adit
