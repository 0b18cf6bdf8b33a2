// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/mesh/box_overlap.hpp"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

using Corners = std::array<Eigen::Vector3d, 3>;

/// Whether the axis has the triangle on one side and the box, at the origin, on the other.
bool separates(const Eigen::Vector3d& axis, const Corners& corners, const Eigen::Vector3d& half) {
  const double reach = half.dot(axis.cwiseAbs());
  const auto [low, high] =
      std::minmax({axis.dot(corners[0]), axis.dot(corners[1]), axis.dot(corners[2])});
  return low > reach || high < -reach;
}

}  // namespace

bool overlaps(const OrientedBox& box, const std::array<Eigen::Vector3d, 3>& triangle) {
  const Eigen::Isometry3d T_box_world = box.T_world_box.inverse();
  Corners corners;
  for (std::size_t i = 0; i < 3; ++i) {
    corners[i] = T_box_world * triangle[i];
    if (!corners[i].allFinite()) return false;
  }
  const Corners edges{corners[1] - corners[0], corners[2] - corners[1], corners[0] - corners[2]};
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d unit = Eigen::Vector3d::Unit(axis);
    if (separates(unit, corners, box.half_size)) return false;
    for (const Eigen::Vector3d& edge : edges) {
      if (separates(unit.cross(edge), corners, box.half_size)) return false;
    }
  }
  return !separates(edges[0].cross(edges[1]), corners, box.half_size);
}

}  // namespace adit
