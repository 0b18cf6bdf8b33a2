// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sim/mesh/mesh_builder.hpp"
#include "sim/world/plan/open_space.hpp"
#include "sim/world/surface/heights.hpp"
#include "sim/world/world_truth.hpp"

namespace adit {

/// Height above the floor of the outlines in the ground truth: that of the lasers [m].
inline constexpr double kOutlineHeight = 0.6;

/// Adds floor, roof and walls to the mesh as three parts. They share vertices where they meet, so
/// that a mine without an entrance is a closed surface. In front of an entrance there is floor
/// only. Returns the outlines of the walls in the mesh, kOutlineHeight above the floor; they run
/// straight across an entrance.
std::vector<PlanRing> add_mine_surface(const OpenSpace& space, const Heights& heights,
                                       double grid_m, double clearance_m, MeshBuilder& builder);

}  // namespace adit
