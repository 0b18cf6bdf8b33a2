// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/world/world.hpp"
#include "sim/world/world_description.hpp"

namespace adit {

/// Builds a world from a mesh file. The floor is the lowest surface with free height above it. The
/// plan is the outline that encloses the start, kOutlineHeight above the floor there, and the
/// outlines in it. Throws std::runtime_error for an unusable file and std::invalid_argument for a
/// start without floor.
World build_mesh_world(const WorldDescription& description);

}  // namespace adit
