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

/// The walls of a mine between floor and roof: upright over the points of a plan, with the bulges
/// of the open space. Frame world.
class WallShape {
 public:
  /// Heights of floor and roof are those of each point of the plan. All must outlive this.
  WallShape(const OpenSpace& space, const PlanMesh& plan, const std::vector<double>& floor_m,
            const std::vector<double>& roof_m);

  /// The wall at a point of the plan that lies on one, at a share of the way from floor to roof.
  [[nodiscard]] Eigen::Vector3d at(std::uint32_t point, double share) const;

 private:
  const OpenSpace& space_;
  const PlanMesh& plan_;
  const std::vector<double>& floor_m_;
  const std::vector<double>& roof_m_;
  std::vector<Eigen::Vector2d> into_open_;  ///< for each point: unit, away from the wall
};

/// Height above the floor at which the outlines of the truth are taken: that of the lasers [m].
inline constexpr double kOutlineHeight = 0.6;

/// Puts floor, roof and walls into the mesh, as three parts. They share the points where they
/// meet, so that a mine without an entrance is closed. In front of an entrance there is floor only.
/// Returns the outlines of the walls as they are in the mesh, kOutlineHeight above the floor; they
/// run straight across an entrance.
std::vector<PlanRing> add_mine_surface(const OpenSpace& space, const Heights& heights,
                                       double grid_m, double clearance_m, MeshBuilder& builder);

}  // namespace adit
