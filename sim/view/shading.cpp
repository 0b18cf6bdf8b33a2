// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/view/shading.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "sim/view/render.hpp"

namespace adit {
namespace {

constexpr float kHair = 2e-3F;  // [m]; at 1 km, rays in single precision have an error of 0.1 mm
constexpr std::size_t kRaysPerPoint = 2;
constexpr std::size_t kDirections = kRaysPerPoint * kSamplesPerPixel;

/// A number in [0, 1) for a cell of the grid (Wang's integer hash).
float lattice(std::int32_t x, std::int32_t y, std::int32_t z) {
  std::uint32_t h = static_cast<std::uint32_t>(x) * 73856093U ^
                    static_cast<std::uint32_t>(y) * 19349663U ^
                    static_cast<std::uint32_t>(z) * 83492791U;
  h = (h ^ 61U) ^ (h >> 16U);
  h *= 9U;
  h ^= h >> 4U;
  h *= 0x27d4eb2dU;
  h ^= h >> 15U;
  return static_cast<float>(h >> 8U) / 16777216.0F;
}

/// Two unit vectors that complete a normal to a right-handed frame (Duff et al., "Building an
/// orthonormal basis, revisited", 2017).
std::array<Eigen::Vector3f, 2> tangents(const Eigen::Vector3f& n) {
  const float sign = std::copysign(1.0F, n.z());
  const float a = -1.0F / (sign + n.z());
  const float b = n.x() * n.y() * a;
  return {Eigen::Vector3f(1.0F + sign * n.x() * n.x() * a, sign * b, -sign * n.x()),
          Eigen::Vector3f(b, sign + n.y() * n.y() * a, -n.y())};
}

/// Directions on the hemisphere around z with cosine-weighted density (Vogel's spiral on the disc).
std::array<Eigen::Vector3f, kDirections> hemisphere() {
  std::array<Eigen::Vector3f, kDirections> directions;
  const double golden_angle = std::numbers::pi * (3.0 - std::sqrt(5.0));
  for (std::size_t i = 0; i < kDirections; ++i) {
    const double share = (static_cast<double>(i) + 0.5) / kDirections;
    const double angle = golden_angle * static_cast<double>(i);
    directions[i] = Eigen::Vector3d(std::sqrt(share) * std::cos(angle),
                                    std::sqrt(share) * std::sin(angle), std::sqrt(1.0 - share))
                        .cast<float>();
  }
  return directions;
}

}  // namespace

ShadedPoint shaded_point(const Ray& ray, const RayHit& hit) {
  return {ray.origin + hit.distance_m * ray.direction + kHair * hit.normal, hit.normal};
}

bool is_mine_surface(PartKind kind) {
  return kind == PartKind::kFloor || kind == PartKind::kRoof || kind == PartKind::kWall ||
         kind == PartKind::kOther;
}

void find_openness(const RayScene& scene, std::span<const ShadedPoint> points, float reach_m,
                   std::span<float> openness) {
  static const std::array<Eigen::Vector3f, kDirections> kHemisphere = hemisphere();
  std::vector<Ray> rays;
  rays.reserve(kRaysPerPoint * points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& [p_world, normal] = points[i];
    const auto [a, b] = tangents(normal);
    // Rotated differently at each point: a fixed set of directions would give star-shaped artefacts
    // around posts.
    const Eigen::Array3i at = (1000.0F * p_world).array().floor().cast<int>();
    const float turn = 2.0F * std::numbers::pi_v<float> * lattice(at.x(), at.y(), at.z());
    const Eigen::Vector3f u = std::cos(turn) * a + std::sin(turn) * b;
    const Eigen::Vector3f v = std::cos(turn) * b - std::sin(turn) * a;
    for (std::size_t k = 0; k < kRaysPerPoint; ++k) {
      const Eigen::Vector3f& d = kHemisphere[i % kSamplesPerPixel + k * kSamplesPerPixel];
      rays.push_back({p_world, d.x() * u + d.y() * v + d.z() * normal});
    }
  }
  std::vector<RayHit> hits(rays.size());
  scene.cast(rays, reach_m, hits);
  for (std::size_t i = 0; i < points.size(); ++i) {
    int open = 0;
    for (std::size_t k = 0; k < kRaysPerPoint; ++k) {
      if (std::isinf(hits[kRaysPerPoint * i + k].distance_m)) ++open;
    }
    openness[i] = static_cast<float>(open) / kRaysPerPoint;
  }
}

double distance_to_rock(const RayScene& scene, const Ray& ray, float reach_m) {
  Ray rest = ray;
  float done_m = 0.0F;
  while (const auto hit = scene.cast(rest, reach_m - done_m)) {
    if (is_mine_surface(scene.mesh().part_of(hit->triangle).kind)) return done_m + hit->distance_m;
    rest.origin = shaded_point(rest, {hit->distance_m, hit->triangle, -hit->normal}).p_world;
    done_m = (rest.origin - ray.origin).norm();
    if (done_m >= reach_m) break;
  }
  return reach_m;
}

}  // namespace adit
