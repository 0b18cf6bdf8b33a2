// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/world_truth.hpp"

#include <cmath>
#include <limits>

#include "sim/world/plan/plan_geometry.hpp"

namespace adit {

double TunnelGraph::length_m() const {
  double length = 0.0;
  for (const TunnelEdge& edge : edges) length += edge.length_m;
  return length;
}

bool PlanRing::is_pillar() const { return signed_area_m2() < 0.0; }

double PlanRing::signed_area_m2() const {
  double twice = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector2d a = points[i] - points[0];  // relative to the first point, for precision
    const Eigen::Vector2d b = points[(i + 1) % points.size()] - points[0];
    twice += cross(a, b);
  }
  return twice / 2.0;
}

std::optional<double> WorldTruth::floor_at(const Eigen::Vector2d& p_world) const {
  return floor_height ? floor_height(p_world) : std::nullopt;
}

std::optional<double> WorldTruth::floor_at(const Eigen::Vector2d& p_world, int level) const {
  return level_floor_height ? level_floor_height(p_world, level) : floor_at(p_world);
}

int WorldTruth::level_at(const Eigen::Vector3d& p_world) const {
  int nearest = levels.front();
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const int level : levels) {
    const auto floor_m = floor_at(p_world.head<2>(), level);
    if (!floor_m || std::abs(*floor_m - p_world.z()) >= nearest_m) continue;
    nearest = level;
    nearest_m = std::abs(*floor_m - p_world.z());
  }
  return nearest;
}

}  // namespace adit
