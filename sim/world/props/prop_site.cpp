// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/props/prop_site.hpp"

#include <algorithm>
#include <limits>

#include "sim/world/props/outlines.hpp"

namespace adit {

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
