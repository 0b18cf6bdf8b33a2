// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/wall_shape.hpp"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

// A wall bulges from nothing at floor and roof to all it may over this share of its height.
constexpr double kShareToBulge = 0.2;

/// At right angles to the line between the neighbours.
std::vector<Eigen::Vector2d> directions_into_open(const PlanMesh& plan) {
  std::vector<Eigen::Vector2d> directions(plan.points.size(), Eigen::Vector2d::Zero());
  std::vector<std::uint32_t> before(plan.points.size(), PlanMesh::kNone);
  for (std::uint32_t i = 0; i < before.size(); ++i) {
    if (plan.is_on_wall(i)) before[plan.next_on_wall[i]] = i;
  }
  for (std::uint32_t i = 0; i < before.size(); ++i) {
    if (!plan.is_on_wall(i)) continue;
    const Eigen::Vector2d along = plan.points[plan.next_on_wall[i]] - plan.points[before[i]];
    directions[i] = Eigen::Vector2d(-along.y(), along.x()).normalized();
  }
  return directions;
}

}  // namespace

WallShape::WallShape(const OpenSpace& space, const PlanMesh& plan,
                     const std::vector<double>& floor_m, const std::vector<double>& roof_m)
    : space_(space),
      plan_(plan),
      floor_m_(floor_m),
      roof_m_(roof_m),
      into_open_(directions_into_open(plan)) {}

Eigen::Vector3d WallShape::at(std::uint32_t point, double share) const {
  const Eigen::Vector2d& p = plan_.points[point];
  const Eigen::Vector3d upright(p.x(), p.y(), std::lerp(floor_m_[point], roof_m_[point], share));
  const double grown = std::min(1.0, std::min(share, 1.0 - share) / kShareToBulge);
  const Eigen::Vector2d back = -grown * space_.bulge_m(upright) * into_open_[point];
  return upright + Eigen::Vector3d(back.x(), back.y(), 0.0);
}

}  // namespace adit
