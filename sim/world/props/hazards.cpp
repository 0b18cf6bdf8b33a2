// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "sim/world/props/outlines.hpp"
#include "sim/world/props/prop_site.hpp"

namespace adit {
namespace {

// Extension beyond the planned walls of props that fill a tunnel from wall to wall, so that the
// relief leaves no gap [m].
constexpr double kBehindWalls = 0.5;
// Horizontal width of the sides of a pit [m].
constexpr double kPitSide = 0.1;

/// The outline of a section of a tunnel, counter-clockwise: the right side forward, then the left
/// side backward; p_world [m].
std::vector<Eigen::Vector2d> section_outline(const TunnelLine& tunnel, double from_m, double to_m) {
  const double aside_m = tunnel.width_m / 2.0 + kBehindWalls;
  const std::vector<double> places = places_between(from_m, to_m, 1.0);
  std::vector<Eigen::Vector2d> outline;
  for (const double s_m : places) outline.push_back(tunnel.beside(s_m, -aside_m));
  for (auto it = places.rbegin(); it != places.rend(); ++it) {
    outline.push_back(tunnel.beside(*it, aside_m));
  }
  return outline;
}

/// Position of a point along a section, 0 to 1; negative if it is not in the section.
double fraction_of_section(const TunnelLine& tunnel, double from_m, double to_m,
                           const Eigen::Vector2d& p_world) {
  const TunnelLine::Place place = tunnel.place_of(p_world);
  if (std::abs(place.across_m) > tunnel.width_m / 2.0 + kBehindWalls) return -1.0;
  const double share = (place.s_m - from_m) / (to_m - from_m);
  return share <= 1.0 ? share : -1.0;
}

/// z of the surface of the water: that of the unchanged floor at the lower end of the section.
double water_level(const WaterDescription& water, const TunnelLine& tunnel,
                   const Heights& heights) {
  return std::min(heights.floor(tunnel.at(water.from_m).p_world),
                  heights.floor(tunnel.at(water.to_m).p_world));
}

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

HeightChange pit_in_floor(const PitDescription& pit, const TunnelLine& tunnel) {
  const Eigen::Vector2d middle = tunnel.beside(pit.at_m, pit.across_m);
  const PlanBox box = box_around(middle, pit.radius_m);
  return {box.low, box.high, [pit, middle](const Eigen::Vector2d& p_world, double floor_m) {
            const double from_edge_m = pit.radius_m - (p_world - middle).norm();
            return floor_m - pit.depth_m * std::clamp(from_edge_m / kPitSide, 0.0, 1.0);
          }};
}

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

HeightChange hollow_under(const WaterDescription& water, const TunnelLine& tunnel,
                          const Heights& bare) {
  const double level_m = water_level(water, tunnel, bare);
  const auto apply = [water, tunnel, level_m](const Eigen::Vector2d& p_world, double floor_m) {
    const double share = fraction_of_section(tunnel, water.from_m, water.to_m, p_world);
    if (share < 0.0) return floor_m;
    const double hollow = 4.0 * share * (1.0 - share);
    return floor_m + hollow * (level_m - water.depth_m - floor_m);
  };
  const PlanBox box = box_around(section_outline(tunnel, water.from_m, water.to_m));
  return {box.low, box.high, apply};
}

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

HeightChange lowered_roof(const LowRoofDescription& low, const TunnelLine& tunnel,
                          const std::shared_ptr<const Heights>& bare) {
  const PlanBox box = box_around(section_outline(tunnel, low.from_m, low.to_m));
  return {box.low, box.high, [low, tunnel, bare](const Eigen::Vector2d& p_world, double roof_m) {
            const double share = fraction_of_section(tunnel, low.from_m, low.to_m, p_world);
            return share < 0.0 ? roof_m : std::min(roof_m, bare->floor(p_world) + low.clearance_m);
          }};
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
