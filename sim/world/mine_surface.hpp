// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sim/mesh/mesh_builder.hpp"
#include "sim/world/heights.hpp"
#include "sim/world/open_space.hpp"
#include "sim/world/world_truth.hpp"

namespace adit {

/// Height above the floor at which the outlines of the truth are taken: that of the lasers [m].
inline constexpr double kOutlineHeight = 0.6;

/// Puts floor, roof and walls into the mesh, as three parts. They share the points where they
/// meet, so that a mine without an entrance is closed. In front of an entrance there is floor only.
/// Returns the outlines of the walls as they are in the mesh, kOutlineHeight above the floor; they
/// run straight across an entrance.
std::vector<PlanRing> add_mine_surface(const OpenSpace& space, const Heights& heights,
                                       double grid_m, double opening_m, MeshBuilder& builder);

}  // namespace adit
