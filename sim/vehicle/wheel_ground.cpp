// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/vehicle/wheel_ground.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace adit {
namespace {

constexpr int kSide = WheelGroundProbe::kSide;
constexpr int kRays = WheelGroundProbe::kRays;
constexpr int kMiddle = kSide / 2;
constexpr double kSpacing = 0.3;  // of the rays along the wheel, in wheel radii
constexpr float kDepthM = 10.0F;  // a shaft that is deeper has no ground
constexpr double kNone = -std::numeric_limits<double>::infinity();

/// What the rays met, row by row along the wheel: heights are kNone where that is nothing.
struct Ground {
  std::array<double, kRays> height_m;
  std::array<std::uint32_t, kRays> triangle;
};

int index(int along, int across) { return along * kSide + across; }

/// Many rays at once see water, too, which carries no wheel.
RayHit below_water(const RayScene& scene, const Ray& ray, const RayHit& hit) {
  if (!std::isfinite(hit.distance_m)) return hit;
  const Material material = scene.mesh().part_of(hit.triangle).material;
  if (material != Material::kWater && material != Material::kMirror) return hit;
  const RayHit none{std::numeric_limits<float>::infinity(), 0, Eigen::Vector3f::Zero()};
  return scene.cast(ray, kDepthM, RayScene::Layer::kSolid).value_or(none);
}

Ground look_down(const RayScene& scene, const std::array<Ray, kRays>& rays) {
  std::array<RayHit, kRays> hits;
  scene.cast(rays, kDepthM, hits);
  Ground ground{};
  for (std::size_t i = 0; i < kRays; ++i) {
    const RayHit hit = below_water(scene, rays[i], hits[i]);
    ground.height_m[i] = static_cast<double>(rays[i].origin.z()) - hit.distance_m;
    ground.triangle[i] = hit.triangle;
  }
  return ground;
}

void find_step(const Ground& ground, WheelGround& wheel) {
  for (int along = 0; along + 2 < kSide; ++along) {
    for (int across = 0; across < kSide; ++across) {
      const int behind = index(along, across);
      const int ahead = index(along + 2, across);
      const double rise = ground.height_m[ahead] - ground.height_m[behind];
      if (!std::isfinite(rise) || std::abs(rise) <= wheel.step_m) continue;
      wheel.step_m = std::abs(rise);
      wheel.step_triangle = ground.triangle[rise > 0.0 ? ahead : behind];
    }
  }
}

}  // namespace

WheelGroundProbe::WheelGroundProbe(const RayScene& scene, const Vehicle& vehicle)
    : scene_(scene),
      wheel_radius_m_(vehicle.wheel_radius_m),
      wheel_width_m_(vehicle.wheel_width_m) {}

std::optional<WheelGround> WheelGroundProbe::under(const WheelPlace& place) const {
  const Eigen::Vector2d ahead(std::cos(place.heading_rad), std::sin(place.heading_rad));
  const Eigen::Vector2d left(-ahead.y(), ahead.x());
  const double spacing_m = kSpacing * wheel_radius_m_;
  std::array<Ray, kRays> rays;
  for (int along = 0; along < kSide; ++along) {
    for (int across = 0; across < kSide; ++across) {
      const double x = (along - kMiddle) * spacing_m;
      const double y = (across - kMiddle) * wheel_width_m_ / (kSide - 1);
      const Eigen::Vector2d p = place.p_world + x * ahead + y * left;
      rays[index(along, across)] = {Eigen::Vector3d(p.x(), p.y(), place.look_from_m).cast<float>(),
                                    -Eigen::Vector3f::UnitZ()};
    }
  }
  const Ground ground = look_down(scene_, rays);

  const auto* middle = ground.height_m.begin() + index(kMiddle, 0);
  if (*std::max_element(middle, middle + kSide) == kNone) return std::nullopt;
  WheelGround wheel{kNone, 0, 0.0, 0};
  for (int along = 0; along < kSide; ++along) {
    const double x = (along - kMiddle) * spacing_m;
    const double rim_m =  // of the wheel above its lowest point
        wheel_radius_m_ - std::sqrt(wheel_radius_m_ * wheel_radius_m_ - x * x);
    for (int across = 0; across < kSide; ++across) {
      const int i = index(along, across);
      if (ground.height_m[i] - rim_m <= wheel.height_m) continue;
      wheel.height_m = ground.height_m[i] - rim_m;
      wheel.triangle = ground.triangle[i];
    }
  }
  find_step(ground, wheel);
  return wheel;
}

}  // namespace adit
