// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/world/props/add_prop.hpp"
#include "sim/world/props/placement.hpp"
#include "sim/world/props/stone.hpp"

namespace adit {
namespace {

constexpr double kSunk = 0.05;   // how far the rim lies under the floor [m]
constexpr double kNoise = 0.12;  // of the surface, as a share of the height
constexpr double kStonesPerM2 = 5.0;

Eigen::Vector2d on_circle(const Eigen::Vector2d& middle, double radius_m, double angle) {
  return middle + radius_m * Eigen::Vector2d(std::cos(angle), std::sin(angle));
}

/// Height of the smooth cone above the floor, `share` of the radius from its middle.
double cone_height(const RubbleDescription& rubble, double share) {
  return rubble.height_m * (1.0 - share);
}

void add_cone(const RubbleDescription& rubble, const Eigen::Vector2d& middle, PropSite& site) {
  const int rings = std::max(4, static_cast<int>(std::ceil(rubble.radius_m / 0.15)));
  const int sectors = std::max(16, static_cast<int>(std::ceil(rubble.radius_m / 0.04)));
  const auto vertex = [&](const Eigen::Vector2d& plan, double above_m) {
    const Eigen::Vector3d p_world(plan.x(), plan.y(), site.heights.floor(plan) + above_m);
    return site.builder.vertex(p_world.cast<float>());
  };
  const std::uint32_t top = vertex(middle, rubble.height_m);
  std::vector<std::uint32_t> inner(static_cast<std::size_t>(sectors), top);
  for (int ring = 1; ring <= rings; ++ring) {
    const double share = static_cast<double>(ring) / rings;
    std::vector<std::uint32_t> outer;
    for (int k = 0; k < sectors; ++k) {
      const double noise_m = rubble.height_m * site.between(-kNoise, kNoise);
      const double above_m =
          ring < rings ? std::max(0.0, cone_height(rubble, share) + noise_m) : -kSunk;
      outer.push_back(
          vertex(on_circle(middle, share * rubble.radius_m, 2.0 * std::numbers::pi * k / sectors),
                 above_m));
    }
    for (std::size_t k = 0; k < outer.size(); ++k) {
      const std::size_t l = (k + 1) % outer.size();
      site.builder.triangle(inner[k], outer[k], outer[l]);
      if (ring > 1) site.builder.triangle(inner[k], outer[l], inner[l]);
    }
    inner = outer;
  }
}

void add_stones(const RubbleDescription& rubble, const Eigen::Vector2d& middle, PropSite& site) {
  const double area_m2 = std::numbers::pi * rubble.radius_m * rubble.radius_m;
  const double largest_m = std::min(0.35, 0.4 * rubble.height_m);
  for (int i = 0; i < static_cast<int>(kStonesPerM2 * area_m2); ++i) {
    const double share = std::sqrt(site.between(0.0, 0.9));
    const Eigen::Vector2d plan =
        on_circle(middle, share * rubble.radius_m, site.between(0.0, 2.0 * std::numbers::pi));
    const double radius_m = site.between(0.3, 1.0) * largest_m;
    const double above_m = cone_height(rubble, share) * site.between(0.8, 1.0);
    add_stone({plan.x(), plan.y(), site.heights.floor(plan) + above_m}, radius_m, site.random,
              site.builder);
  }
}

}  // namespace

void add_prop(const RubbleDescription& rubble, PropSite& site) {
  const DriftLine& drift = drift_with(site.drifts, rubble.drift, rubble.at_m, site.what);
  const Eigen::Vector2d middle = drift.beside(rubble.at_m, rubble.across_m);
  const std::size_t first = begin_obstacle(site, PartKind::kRubble, Material::kRock, "rubble");
  add_cone(rubble, middle, site);
  add_stones(rubble, middle, site);
  end_obstacle(site, first);
}

}  // namespace adit
