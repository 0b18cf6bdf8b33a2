// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <Eigen/Geometry>

#include "sim/world/props/outlines.hpp"
#include "sim/world/props/prop_site.hpp"

namespace adit {
namespace {

/// Random displacement of the corners, relative to their distance from the centre: small enough
/// that the facets of the icosahedron remain those of the convex hull.
constexpr double kShake = 0.12;

constexpr double kSunk = 0.05;   // how far the rim lies under the floor [m]
constexpr double kNoise = 0.12;  // of the surface, as a fraction of the height
constexpr double kStonesPerM2 = 5.0;
constexpr double kBulking = 1.5;  // volume of fallen rock relative to that of its cavity

std::array<Eigen::Vector3d, 12> icosahedron() {
  const double g = std::numbers::phi;
  return {Eigen::Vector3d(-1, g, 0),
          {1, g, 0},
          {-1, -g, 0},
          {1, -g, 0},
          {0, -1, g},
          {0, 1, g},
          {0, -1, -g},
          {0, 1, -g},
          {g, 0, -1},
          {g, 0, 1},
          {-g, 0, -1},
          {-g, 0, 1}};
}

constexpr std::array<std::array<std::size_t, 3>, 20> kFacets{
    {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
     {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
     {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};

Eigen::Vector3d random_vector(double low, double high, std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(low, high);
  const double x = uniform(random);
  const double y = uniform(random);
  return {x, y, uniform(random)};
}

Eigen::Matrix3d random_rotation(std::mt19937_64& random) {
  const Eigen::Vector3d axis = random_vector(-1.0, 1.0, random);
  const double angle = random_vector(0.0, std::numbers::pi, random).x();
  return Eigen::AngleAxisd(angle, (axis + Eigen::Vector3d(0.0, 0.0, 2.0)).normalized())
      .toRotationMatrix();
}

Eigen::Vector2d on_circle(const Eigen::Vector2d& middle, double radius_m, double angle) {
  return middle + radius_m * Eigen::Vector2d(std::cos(angle), std::sin(angle));
}

/// Height of the smooth cone above the floor at the fraction `share` of the radius.
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

void add_stone(const Eigen::Vector3d& middle, double radius_m, std::mt19937_64& random,
               MeshBuilder& builder) {
  const Eigen::Vector3d half_axes = radius_m * random_vector(0.5, 1.0, random);
  const Eigen::Matrix3d rotation = random_rotation(random);
  std::array<std::uint32_t, 12> corners{};
  const auto regular = icosahedron();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector3d shaken =
        (regular[i].normalized() + random_vector(-kShake, kShake, random)).normalized();
    const Eigen::Vector3d p_world = middle + rotation * half_axes.cwiseProduct(shaken);
    corners[i] = builder.vertex(p_world.cast<float>());
  }
  for (const auto& [a, b, c] : kFacets) builder.triangle(corners[a], corners[b], corners[c]);
}

HeightChange cavity_above(const RubbleDescription& rubble, const TunnelLine& tunnel) {
  const Eigen::Vector2d middle = tunnel.beside(rubble.at_m, rubble.across_m);
  // On the same base, paraboloid and cone have half and a third of the volume of their cylinder.
  const double rise_m = rubble.height_m * (2.0 / 3.0) / kBulking;
  const PlanBox box = box_around(middle, rubble.radius_m);
  return {box.low, box.high,
          [=, radius_m = rubble.radius_m](const Eigen::Vector2d& p_world, double roof_m) {
            const double share2 = (p_world - middle).squaredNorm() / (radius_m * radius_m);
            return roof_m + rise_m * std::max(0.0, 1.0 - share2);
          }};
}

void add_prop(const RubbleDescription& rubble, PropSite& site) {
  const TunnelLine& tunnel = tunnel_with(site.tunnels, rubble.tunnel, rubble.at_m, site.what);
  const Eigen::Vector2d middle = tunnel.beside(rubble.at_m, rubble.across_m);
  const std::size_t first = begin_obstacle(site, PartKind::kRubble, Material::kRock, "rubble");
  add_cone(rubble, middle, site);
  add_stones(rubble, middle, site);
  end_obstacle(site, first);
}

}  // namespace adit
