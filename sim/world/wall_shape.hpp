// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "sim/world/open_space.hpp"
#include "sim/world/plan_mesh.hpp"

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

}  // namespace adit
