// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/world/world.hpp"
#include "sim/world/world_description.hpp"

namespace adit {

/// Builds a world from its description. The same description gives the same world, bit for bit.
/// The floor of a mesh file is its lowest surface with free height above it; the plan is the
/// outline that encloses the start, kOutlineHeight above the floor there, and the outlines in it.
/// Throws std::invalid_argument, one line that names the part, for a description that cannot be
/// built: neither tunnel nor room, a plan beyond OpenSpace::kExtentMax, an odd list of points, a
/// prop in an unknown tunnel or beyond its end, a start in rock or without floor (with a place that
/// has floor). Throws
/// std::runtime_error for an unusable mesh file.
World build_world(const WorldDescription& description);

}  // namespace adit
