// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/unit/procs/terrain/memory_scenes.hpp"

#include <cmath>

#include "common/geometry/in_plan.hpp"
#include "sim/sweep/tilt_sweep.hpp"

namespace adit {

void LookingVehicle::drive_to(const Pose2& T_world_body) {
  constexpr double kPieceM = 0.05;
  const Pose2 from = T_world_body_;
  const Eigen::Vector2d way = T_world_body.translation() - from.translation();
  const int pieces = static_cast<int>(std::ceil(way.norm() / kPieceM));
  for (int i = 1; i <= pieces; ++i) {
    const Eigen::Vector2d p = from.translation() + way * i / pieces;
    utime_ += 125'000;
    memory_.add(utime_, {p.x(), p.y(), T_world_body.theta});
  }
  T_world_body_ = T_world_body;
}

TerrainMap LookingVehicle::look(const Build& build, bool rear, double floor_m,
                                const Pose2& T_odom_world) {
  MeshBuilder builder;
  builder.begin_part(PartKind::kFloor, Material::kRock, "rock");
  build(builder);
  World world;
  world.mesh = builder.take();
  TiltSweep sweep;
  if (rear) sweep.mount = groundhog_lasers().rear;
  Cloud cloud = tilt_sweep(Site(std::move(world)), in_space(T_world_body_, floor_m), sweep);
  utime_ += 10'000'000;
  cloud.utime = utime_;
  cloud.T_odom_level = T_odom_world * cloud.T_odom_level;
  return terrain_.make(cloud, memory_);
}

}  // namespace adit
