// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/props/add_prop.hpp"
#include "sim/world/props/circle.hpp"
#include "sim/world/props/placement.hpp"

namespace adit {

void add_prop(const MudDescription& mud, PropSite& site) {
  const DriftLine& drift = drift_with(site.drifts, mud.drift, mud.at_m, site.what);
  const Eigen::Vector2d middle = drift.beside(mud.at_m, mud.across_m);
  site.builder.begin_part(PartKind::kFloor, Material::kMud, mud.name);
  site.builder.take_over([&](const Part& part, const Eigen::Vector3f& p_world) {
    return part.kind == PartKind::kFloor &&
           (p_world.head<2>().cast<double>() - middle).norm() < mud.radius_m;
  });
  const double floor_m = site.heights.floor(middle);
  site.world.soft_ground.push_back({mud.name, middle, mud.radius_m, mud.depth_m});
  site.world.truth.obstacles.push_back({.kind = PartKind::kFloor,
                                        .name = site.builder.mesh().parts.back().name,
                                        .outline = around_circle(middle, mud.radius_m),
                                        .z_low_m = floor_m - mud.depth_m,
                                        .z_high_m = floor_m});
}

}  // namespace adit
