// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/props/water.hpp"

#include <algorithm>

#include "sim/world/props/outlines.hpp"
#include "sim/world/props/placement.hpp"
#include "sim/world/props/prop_site.hpp"

namespace adit {

double water_level(const WaterDescription& water, const TunnelLine& tunnel,
                   const Heights& heights) {
  return std::min(heights.floor(tunnel.at(water.from_m).p_world),
                  heights.floor(tunnel.at(water.to_m).p_world));
}

HeightChange water_hollow(const WaterDescription& water, const TunnelLine& tunnel, double level_m) {
  const auto apply = [water, tunnel, level_m](const Eigen::Vector2d& p_world, double floor_m) {
    const double share = fraction_of_section(tunnel, water.from_m, water.to_m, p_world);
    if (share < 0.0) return floor_m;
    const double hollow = 4.0 * share * (1.0 - share);
    return floor_m + hollow * (level_m - water.depth_m - floor_m);
  };
  const PlanBox box = box_around(section_outline(tunnel, water.from_m, water.to_m));
  return {box.low, box.high, apply};
}

namespace {

/// A flat strip between the two sides of an outline by `section_outline`.
void add_surface(const std::vector<Eigen::Vector2d>& outline, double level_m,
                 MeshBuilder& builder) {
  std::vector<std::uint32_t> rim;
  for (const Eigen::Vector2d& plan : outline) {
    rim.push_back(builder.vertex(Eigen::Vector3d(plan.x(), plan.y(), level_m).cast<float>()));
  }
  const std::size_t last = rim.size() - 1;
  for (std::size_t i = 0; i + 1 < rim.size() / 2; ++i) {
    builder.quad(rim[i], rim[i + 1], rim[last - i - 1], rim[last - i]);
  }
}

}  // namespace

void add_prop(const WaterDescription& water, PropSite& site) {
  const TunnelLine& tunnel =
      tunnel_with(site.tunnels, water.tunnel, water.from_m, water.to_m, site.what);
  const double level_m = water_level(water, tunnel, site.heights);
  const std::vector<Eigen::Vector2d> outline = section_outline(tunnel, water.from_m, water.to_m);

  site.builder.begin_part(PartKind::kWater, water.mirror ? Material::kMirror : Material::kWater,
                          water.name);
  add_surface(outline, level_m, site.builder);
  site.world.water.push_back({water.name, outline, level_m});
  site.world.truth.obstacles.push_back({.kind = PartKind::kWater,
                                        .name = site.builder.mesh().parts.back().name,
                                        .outline = convex_outline(outline),
                                        .z_low_m = level_m - water.depth_m,
                                        .z_high_m = level_m});
}

}  // namespace adit
