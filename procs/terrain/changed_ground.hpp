// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "procs/terrain/remembered_map.hpp"
#include "procs/terrain/terrain_params.hpp"

namespace adit {

/// The cells, marked by 1, of which an earlier look is not to be believed: those that the new one
/// does not see, around obstacles where earlier looks saw even ground. Of a rock that has fallen
/// only one side is seen, and what it hides may be the rest of it. `recalled`: what earlier looks
/// say of the cells of the map.
std::vector<std::uint8_t> changed_ground(const TerrainMap& now,
                                         const std::vector<RememberedCell>& recalled,
                                         const TerrainParams& params);

}  // namespace adit
