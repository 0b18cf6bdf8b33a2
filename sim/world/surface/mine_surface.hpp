// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "sim/mesh/mesh_builder.hpp"
#include "sim/world/plan/open_space.hpp"
#include "sim/world/surface/heights.hpp"
#include "sim/world/surface/plan_mesh.hpp"
#include "sim/world/world_truth.hpp"

namespace adit {

/// The walls of a mine between floor and roof: vertical above the points of a plan, with the bulges
/// of the open space. Frame world.
class WallShape {
 public:
  /// Heights of floor and roof are those of each point of the plan. All must outlive this.
  WallShape(const OpenSpace& space, const PlanMesh& plan, const std::vector<double>& floor_m,
            const std::vector<double>& roof_m);

  /// The point of the wall above a wall point of the plan, at a fraction of the height from floor
  /// to roof.
  [[nodiscard]] Eigen::Vector3d at(std::uint32_t point, double share) const;

 private:
  const OpenSpace& space_;
  const PlanMesh& plan_;
  const std::vector<double>& floor_m_;
  const std::vector<double>& roof_m_;
  std::vector<Eigen::Vector2d> into_open_;  ///< for each point: unit, away from the wall
};

/// Height above the floor of the outlines in the ground truth: that of the lasers [m].
inline constexpr double kOutlineHeight = 0.6;

/// Adds floor, roof and walls to the mesh as three parts. They share vertices where they meet, so
/// that a mine without an entrance is a closed surface. In front of an entrance there is floor
/// only. Returns the outlines of the walls in the mesh, kOutlineHeight above the floor; they run
/// straight across an entrance.
std::vector<PlanRing> add_mine_surface(const OpenSpace& space, const Heights& heights,
                                       double grid_m, double clearance_m, MeshBuilder& builder);

}  // namespace adit
