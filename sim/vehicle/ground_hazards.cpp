// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/vehicle/ground_hazards.hpp"

namespace adit {

Sinkage sinkage_at(const World& world, const Eigen::Vector2d& p_world) {
  Sinkage deepest;
  for (const SoftGround& ground : world.soft_ground) {
    const double r2 = (p_world - ground.p_world).squaredNorm();
    const double u = 1.0 - r2 / (ground.radius_m * ground.radius_m);
    if (u <= 0.0) continue;
    const double depth_m = ground.depth_m * u * u;
    if (depth_m > deepest.depth_m) deepest = {depth_m, ground.name};
  }
  return deepest;
}

namespace {

/// Counts the crossings of a ray along x (Shimrat, "Algorithm 112", 1962).
bool is_inside(const std::vector<Eigen::Vector2d>& outline, const Eigen::Vector2d& p) {
  bool inside = false;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d& a = outline[i];
    const Eigen::Vector2d& b = outline[(i + 1) % outline.size()];
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    const double x = a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y());
    if (p.x() < x) inside = !inside;
  }
  return inside;
}

}  // namespace

std::optional<WaterAbove> water_above(const World& world, const Eigen::Vector3d& p_world) {
  std::optional<WaterAbove> deepest;
  for (const StandingWater& water : world.water) {
    const double depth_m = water.level_m - p_world.z();
    if (depth_m <= (deepest ? deepest->depth_m : 0.0)) continue;
    if (is_inside(water.outline, p_world.head<2>())) deepest = WaterAbove{depth_m, water.name};
  }
  return deepest;
}

}  // namespace adit
