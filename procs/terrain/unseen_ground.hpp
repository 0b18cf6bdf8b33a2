// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/cloud/cloud.hpp"
#include "common/terrain/terrain_map.hpp"
#include "procs/terrain/cell_heights.hpp"
#include "procs/terrain/ground_level.hpp"
#include "procs/terrain/terrain_params.hpp"

namespace adit {

/// Says of the cells that no point shows why not, from the beams that went there, and gives those
/// between beams that met the ground its height. Where lasers looked from several places, the one
/// that knows most is believed.
void tell_unseen_ground_apart(TerrainMap& map, const Cloud& cloud, const CellHeights& heights,
                              const GroundLevel& ground, const TerrainParams& params);

}  // namespace adit
