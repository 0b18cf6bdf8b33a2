// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/props/stone.hpp"

#include <array>
#include <numbers>

#include <Eigen/Geometry>

namespace adit {
namespace {

/// Corners are shaken by so little, of their distance 1 from the middle, that the facets of an
/// icosahedron remain those of the convex hull.
constexpr double kShake = 0.12;

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

}  // namespace adit
