// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/world/props/add_prop.hpp"
#include "sim/world/props/placement.hpp"

namespace adit {
namespace {

// How deep the ends stand in floor and roof, so that relief leaves no gap [m].
constexpr double kSunk = 0.05;
// How much radii differ from post to post, to either side.
constexpr double kRadiusSpread = 0.15;

std::string next_name(const World& world) {
  const auto posts = std::count_if(world.truth.obstacles.begin(), world.truth.obstacles.end(),
                                   [](const Obstacle& o) { return o.kind == PartKind::kPost; });
  return "post_" + std::to_string(posts + 1);
}

void add_post(const PostsDescription& posts, const DriftLine& drift, double s_m, double across_m,
              PropSite& site) {
  const double radius_m = posts.radius_m * site.between(1.0 - kRadiusSpread, 1.0 + kRadiusSpread);
  const double lean = std::tan(site.between(0.0, posts.lean_rad));
  const double towards = site.between(-std::numbers::pi, std::numbers::pi);
  const Eigen::Vector3d foot = on_floor(site, drift, s_m, across_m);
  const double opening_m = site.heights.roof(foot.head<2>()) - foot.z();
  const Eigen::Vector2d plan =
      foot.head<2>() + opening_m * lean * Eigen::Vector2d(std::cos(towards), std::sin(towards));
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
  const DriftLine& drift = drift_with(site.drifts, posts.drift, posts.from_m, site.what);
  drift_with(site.drifts, posts.drift, last_m, site.what);
  for (double s_m = posts.from_m; s_m <= last_m; s_m += posts.every_m) {
    add_post(posts, drift, s_m, posts.across_m, site);
    if (posts.both_sides) add_post(posts, drift, s_m, -posts.across_m, site);
  }
}

}  // namespace adit
