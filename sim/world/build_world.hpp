// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "sim/world/world.hpp"
#include "sim/world/world_description.hpp"

namespace adit {

/// Makes the world that is described. The same description gives the same world, bit for bit.
/// Throws std::invalid_argument, one line that names the part, for what cannot be built: no drift
/// and no room, a plan beyond OpenSpace::kExtentMax, an odd list of points, a prop in a drift that
/// does not exist or beyond its end, a start in rock. Throws std::runtime_error for a mesh file
/// that cannot be used.
World build_world(const WorldDescription& description);

}  // namespace adit
