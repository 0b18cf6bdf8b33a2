// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/props/prop_site.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "common/config/number_text.hpp"
#include "common/text/message_text.hpp"
#include "sim/world/props/outlines.hpp"

namespace adit {
namespace {

void require_along(const TunnelLine& tunnel, double at_m, const std::string& what) {
  if (at_m >= 0.0 && at_m <= tunnel.length_m()) return;
  throw std::invalid_argument(fmt::format("{}: {} m is not along tunnel {}, which is {} m long",
                                          what, number_text(at_m), quote(tunnel.name),
                                          number_text(tunnel.length_m())));
}

}  // namespace

const TunnelLine& tunnel_with(const std::vector<TunnelLine>& tunnels, const std::string& name,
                              double at_m, const std::string& what) {
  const TunnelLine& tunnel = find_tunnel(tunnels, name, what);
  require_along(tunnel, at_m, what);
  return tunnel;
}

const TunnelLine& tunnel_with(const std::vector<TunnelLine>& tunnels, const std::string& name,
                              double from_m, double to_m, const std::string& what) {
  const TunnelLine& tunnel = tunnel_with(tunnels, name, from_m, what);
  require_along(tunnel, to_m, what);
  if (to_m > from_m) return tunnel;
  throw std::invalid_argument(fmt::format("{}: ends at {} m, and begins at {} m", what,
                                          number_text(to_m), number_text(from_m)));
}

std::vector<double> places_between(double from_m, double to_m, double step_m) {
  const int steps = std::max(1, static_cast<int>(std::ceil((to_m - from_m) / step_m)));
  std::vector<double> places;
  for (int i = 0; i <= steps; ++i) places.push_back(from_m + (to_m - from_m) * i / steps);
  return places;
}

Eigen::Vector3d on_floor(const PropSite& site, const TunnelLine& tunnel, double s_m,
                         double across_m) {
  const Eigen::Vector2d p_world = tunnel.beside(s_m, across_m);
  return {p_world.x(), p_world.y(), site.heights.floor(p_world)};
}

Eigen::Isometry3d tunnel_axes(const TunnelLine& tunnel, double s_m,
                              const Eigen::Vector3d& p_world) {
  Eigen::Isometry3d T_world_axes = Eigen::Isometry3d::Identity();
  T_world_axes.translation() = p_world;
  T_world_axes.rotate(Eigen::AngleAxisd(tunnel.at(s_m).heading_rad, Eigen::Vector3d::UnitZ()));
  return T_world_axes;
}

std::size_t begin_obstacle(PropSite& site, PartKind kind, Material material,
                           const std::string& name) {
  site.builder.begin_part(kind, material, name);
  return site.builder.mesh().vertices.size();
}

void end_obstacle(PropSite& site, std::size_t first_vertex) {
  const TriangleMesh& mesh = site.builder.mesh();
  Obstacle obstacle{.kind = mesh.parts.back().kind,
                    .name = mesh.parts.back().name,
                    .outline = {},
                    .z_low_m = std::numeric_limits<double>::infinity(),
                    .z_high_m = -std::numeric_limits<double>::infinity()};
  std::vector<Eigen::Vector2d> plan;
  for (std::size_t i = first_vertex; i < mesh.vertices.size(); ++i) {
    const Eigen::Vector3d p_world = mesh.vertices[i].cast<double>();
    plan.emplace_back(p_world.head<2>());
    obstacle.z_low_m = std::min(obstacle.z_low_m, p_world.z());
    obstacle.z_high_m = std::max(obstacle.z_high_m, p_world.z());
  }
  obstacle.outline = convex_outline(std::move(plan));
  site.world.truth.obstacles.push_back(std::move(obstacle));
}

}  // namespace adit
