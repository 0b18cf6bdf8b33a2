// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "common/terrain/terrain_map.hpp"

namespace adit {

/// Whether beams passed over a cell, but over few around it: from afar they are spread so far that
/// even ground has such gaps. No wheel falls into them. Drops are wider.
bool is_narrow_gap(const TerrainMap& map, int column, int row);

/// Takes for ground what is not known between cells with even ground: single cells and rows of
/// them, where `changed` is 0. Regions of the terrain bridge as much.
void close_narrow_gaps(TerrainMap& map, const std::vector<std::uint8_t>& changed, float obstacle_m);

}  // namespace adit
