// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/props/add_prop.hpp"
#include "sim/world/props/convex_outline.hpp"
#include "sim/world/props/placement.hpp"
#include "sim/world/props/stretch.hpp"
#include "sim/world/props/water_shape.hpp"

namespace adit {
namespace {

/// A flat strip between the two sides of an outline that `stretch_outline` made.
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
  const DriftLine& drift =
      drift_with(site.drifts, water.drift, water.from_m, water.to_m, site.what);
  const double level_m = water_level(water, drift, site.heights);
  const std::vector<Eigen::Vector2d> outline = stretch_outline(drift, water.from_m, water.to_m);

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
