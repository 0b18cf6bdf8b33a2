// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sim/mesh/mesh_builder.hpp"
#include "sim/world/plan/tunnel_line.hpp"
#include "sim/world/surface/heights.hpp"
#include "sim/world/world.hpp"

namespace adit {

/// Applies the changes of floor and roof by props: pits, hollows under water, low roofs, cavities
/// above roof falls. Must be called before the surfaces are built. Throws std::invalid_argument
/// with the name of the prop for an unknown tunnel or a position beyond its end.
void apply_height_changes(const PropDescriptions& props, const std::vector<TunnelLine>& tunnels,
                          Heights& heights);

/// Adds the props to the mesh, and their ground truth to the world: obstacles, soft ground, water,
/// gas. `seed` is that of their random dimensions. Throws as above.
void add_props(const PropDescriptions& props, const std::vector<TunnelLine>& tunnels,
               const Heights& heights, int seed, MeshBuilder& builder, World& world);

}  // namespace adit
