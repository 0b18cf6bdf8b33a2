// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "sim/mesh/mesh_builder.hpp"
#include "sim/world/plan/open_space.hpp"
#include "sim/world/surface/heights.hpp"
#include "sim/world/world_truth.hpp"

namespace adit {

/// Height above the floor of the outlines in the ground truth: that of the lasers [m].
inline constexpr double kOutlineHeight = 0.6;

/// The part of a plan whose surfaces are built, of one that overlaps with others.
struct OwnedPart {
  /// Whether a triangle belongs to the part, by its middle in plan.
  std::function<bool(const Eigen::Vector2d& p_world)> owns;
  /// Whether vertices there may be those of another plan.
  std::function<bool(const Eigen::Vector2d& p_world)> is_shared;
};

/// Vertices that the surfaces of several plans share, by their place in the plan: the same bits,
/// since the plans are the same there. Floor, roof, first one of the wall above the floor.
using SharedVertices = std::map<std::pair<double, double>, std::array<std::uint32_t, 3>>;

/// Adds floor, roof and walls to the mesh as three parts. They share vertices where they meet, so
/// that a mine without an entrance is a closed surface. In front of an entrance there is floor
/// only. Returns the outlines of the walls in the mesh, kOutlineHeight above the floor; they run
/// straight across an entrance.
std::vector<PlanRing> add_mine_surface(const OpenSpace& space, const Heights& heights,
                                       double grid_m, double clearance_m, MeshBuilder& builder);

/// The same for a part of the plan. The outlines are those of the complete plan.
std::vector<PlanRing> add_mine_surface(const OpenSpace& space, const Heights& heights,
                                       double grid_m, double clearance_m, const OwnedPart& part,
                                       SharedVertices& shared, MeshBuilder& builder);

}  // namespace adit
