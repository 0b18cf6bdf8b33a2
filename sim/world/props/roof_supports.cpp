// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "sim/world/props/prop_site.hpp"

namespace adit {
namespace {

// Depth of the ends in floor and roof, so that the relief leaves no gap [m].
constexpr double kSunk = 0.05;
// Relative variation of the radii, to either side.
constexpr double kRadiusSpread = 0.15;

std::string next_name(const World& world) {
  const auto posts = std::count_if(world.truth.obstacles.begin(), world.truth.obstacles.end(),
                                   [](const Obstacle& o) { return o.kind == PartKind::kPost; });
  return fmt::format("post_{}", posts + 1);
}

void add_post(const PostsDescription& posts, const TunnelLine& tunnel, double s_m, double across_m,
              PropSite& site) {
  const double radius_m = posts.radius_m * site.between(1.0 - kRadiusSpread, 1.0 + kRadiusSpread);
  const double lean = std::tan(site.between(0.0, posts.lean_rad));
  const double towards = site.between(-std::numbers::pi, std::numbers::pi);
  const Eigen::Vector3d foot = on_floor(site, tunnel, s_m, across_m);
  const double clearance_m = site.heights.roof(foot.head<2>()) - foot.z();
  const Eigen::Vector2d plan =
      foot.head<2>() + clearance_m * lean * Eigen::Vector2d(std::cos(towards), std::sin(towards));
  const Eigen::Vector3d top(plan.x(), plan.y(), site.heights.roof(plan));

  const std::size_t first =
      begin_obstacle(site, PartKind::kPost, Material::kTimber, next_name(site.world));
  const Eigen::Vector3d sunk = kSunk * (top - foot).normalized();
  site.builder.bar(foot - sunk, top + sunk, radius_m);
  end_obstacle(site, first);
}

}  // namespace

void add_prop(const PostsDescription& posts, PropSite& site) {
  const bool row = posts.to_m > posts.from_m;
  const double last_m = row ? posts.to_m : posts.from_m;
  const TunnelLine& tunnel = tunnel_with(site.tunnels, posts.tunnel, posts.from_m, site.what);
  tunnel_with(site.tunnels, posts.tunnel, last_m, site.what);
  for (double s_m = posts.from_m; s_m <= last_m; s_m += posts.every_m) {
    add_post(posts, tunnel, s_m, posts.across_m, site);
    if (posts.both_sides) add_post(posts, tunnel, s_m, -posts.across_m, site);
  }
}

namespace {

constexpr double kTimber = 0.15;  // side of the section of a timber [m]

/// Two parallel timbers along x of the layer's frame `T_world_layer`.
void add_layer(const Eigen::Isometry3d& T_world_layer, double side_m, MeshBuilder& builder) {
  for (const double side : {-1.0, 1.0}) {
    OrientedBox timber;
    timber.T_world_box = T_world_layer;
    timber.T_world_box.translate(Eigen::Vector3d(0.0, side * (side_m - kTimber) / 2.0, 0.0));
    timber.half_size = {side_m / 2.0, kTimber / 2.0, kTimber / 2.0};
    builder.box(timber);
  }
}

}  // namespace

void add_prop(const CribDescription& crib, PropSite& site) {
  const TunnelLine& tunnel = tunnel_with(site.tunnels, crib.tunnel, crib.at_m, site.what);
  const Eigen::Vector3d foot = on_floor(site, tunnel, crib.at_m, crib.across_m);
  const double roof_m = site.heights.roof(foot.head<2>());

  const std::size_t first = begin_obstacle(site, PartKind::kCrib, Material::kTimber, "crib");
  Eigen::Isometry3d T_world_layer = tunnel_axes(tunnel, crib.at_m, foot);
  T_world_layer.rotate(Eigen::AngleAxisd(site.between(-0.2, 0.2), Eigen::Vector3d::UnitZ()));
  // The lowest layer is half below the floor, and the uppermost layer penetrates the roof.
  while (T_world_layer.translation().z() < roof_m) {
    add_layer(T_world_layer, crib.side_m, site.builder);
    T_world_layer.translate(Eigen::Vector3d(0.0, 0.0, kTimber));
    T_world_layer.rotate(Eigen::AngleAxisd(std::numbers::pi / 2.0 + site.between(-0.02, 0.02),
                                           Eigen::Vector3d::UnitZ()));
  }
  end_obstacle(site, first);
}

}  // namespace adit
