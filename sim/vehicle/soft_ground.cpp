// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/vehicle/soft_ground.hpp"

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

}  // namespace adit
