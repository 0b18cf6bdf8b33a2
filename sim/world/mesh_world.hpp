// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/world/world.hpp"
#include "sim/world/world_description.hpp"

namespace adit {

/// The world of a mesh file. Its floor is the lowest surface with room above it. Its plan is what
/// closes around the start kOutlineHeight above the floor there, and what stands in it. Throws
/// std::runtime_error for a file that cannot be used, std::invalid_argument for a start without
/// floor.
World build_mesh_world(const WorldDescription& description);

}  // namespace adit
