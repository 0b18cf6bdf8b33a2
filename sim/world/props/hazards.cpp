// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <limits>

#include "sim/world/props/outlines.hpp"
#include "sim/world/props/placement.hpp"
#include "sim/world/props/prop_site.hpp"

namespace adit {

// apply_height_changes() has already lowered the floor.
void add_prop(const PitDescription& pit, PropSite& site) {
  const TunnelLine& tunnel = tunnel_with(site.tunnels, pit.tunnel, pit.at_m, site.what);
  const Eigen::Vector2d middle = tunnel.beside(pit.at_m, pit.across_m);
  const double bottom_m = site.heights.floor(middle);
  site.world.truth.obstacles.push_back({.kind = PartKind::kFloor,
                                        .name = pit.name,
                                        .outline = around_circle(middle, pit.radius_m),
                                        .z_low_m = bottom_m,
                                        .z_high_m = bottom_m + pit.depth_m});
}

void add_prop(const MudDescription& mud, PropSite& site) {
  const TunnelLine& tunnel = tunnel_with(site.tunnels, mud.tunnel, mud.at_m, site.what);
  const Eigen::Vector2d middle = tunnel.beside(mud.at_m, mud.across_m);
  site.builder.begin_part(PartKind::kFloor, Material::kMud, mud.name);
  site.builder.reassign([&](const Part& part, const Eigen::Vector3f& p_world) {
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

// apply_height_changes() has already lowered the roof.
void add_prop(const LowRoofDescription& low, PropSite& site) {
  const TunnelLine& tunnel = tunnel_with(site.tunnels, low.tunnel, low.from_m, low.to_m, site.what);
  Obstacle obstacle{.kind = PartKind::kRoof,
                    .name = low.name,
                    .outline = convex_outline(section_outline(tunnel, low.from_m, low.to_m)),
                    .z_low_m = std::numeric_limits<double>::infinity(),
                    .z_high_m = -std::numeric_limits<double>::infinity()};
  for (const double s_m : places_between(low.from_m, low.to_m, 0.2)) {
    for (const double across_m : places_between(-tunnel.width_m / 2.0, tunnel.width_m / 2.0, 0.2)) {
      const double roof_m = site.heights.roof(tunnel.beside(s_m, across_m));
      obstacle.z_low_m = std::min(obstacle.z_low_m, roof_m);
      obstacle.z_high_m = std::max(obstacle.z_high_m, roof_m);
    }
  }
  site.world.truth.obstacles.push_back(std::move(obstacle));
}

void add_prop(const GasDescription& gas, PropSite& site) {
  const TunnelLine& tunnel = tunnel_with(site.tunnels, gas.tunnel, gas.at_m, site.what);
  site.world.gas.push_back(
      {gas.name, tunnel.at(gas.at_m).p_world, gas.radius_m, gas.methane_share});
}

}  // namespace adit
