// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sim/mesh/mesh_builder.hpp"
#include "sim/world/plan/tunnel_line.hpp"
#include "sim/world/surface/heights.hpp"
#include "sim/world/world.hpp"

namespace adit {

/// What the props do to floor and roof: pits, hollows under water, low roof, cavities above falls.
/// To be asked before the surfaces are made. Throws std::invalid_argument, naming the prop, for one
/// in no drift or beyond its end.
void apply_height_changes(const PropDescriptions& props, const std::vector<TunnelLine>& tunnels,
                          Heights& heights);

/// Puts the props into the mesh, and what is to be known of them into the world: obstacles of its
/// truth, soft ground, water, gas. `seed` is that of what is random in them. Throws as above.
void add_props(const PropDescriptions& props, const std::vector<TunnelLine>& tunnels,
               const Heights& heights, int seed, MeshBuilder& builder, World& world);

}  // namespace adit
