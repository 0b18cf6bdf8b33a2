// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/vehicle/wheel_ground.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "common/geometry/pose2.hpp"

namespace adit {
namespace {

constexpr int kSide = 5;
constexpr int kRays = kSide * kSide;
constexpr int kMiddle = kSide / 2;
constexpr double kSpacing = 0.3;  // of the rays along the wheel, in wheel radii
constexpr float kDepthM = 10.0F;  // a shaft that is deeper has no ground
constexpr double kNone = -std::numeric_limits<double>::infinity();

/// What the rays met, row by row along the wheel: heights are kNone where that is nothing.
struct Ground {
  std::array<double, kRays> height_m;
  std::array<std::uint32_t, kRays> triangle;
};

/// Counted from the middle of the wheel.
int along(int ray) { return ray / kSide - kMiddle; }
int across(int ray) { return ray % kSide - kMiddle; }

Ground look_down(const RayScene& scene, const std::array<Ray, kRays>& rays) {
  std::array<RayHit, kRays> hits;
  scene.cast(rays, kDepthM, hits, RayScene::Layer::kSolid);
  Ground ground{};
  for (std::size_t i = 0; i < kRays; ++i) {
    ground.height_m[i] = static_cast<double>(rays[i].origin.z()) - hits[i].distance_m;
    ground.triangle[i] = hits[i].triangle;
  }
  return ground;
}

bool has_ground_below_middle(const Ground& ground) {
  for (int i = 0; i < kRays; ++i) {
    if (along(i) == 0 && ground.height_m[i] != kNone) return true;
  }
  return false;
}

void rest_on(const Ground& ground, double radius_m, WheelGround& wheel) {
  for (int i = 0; i < kRays; ++i) {
    const double x = along(i) * kSpacing * radius_m;
    const double rim_m = radius_m - std::sqrt(radius_m * radius_m - x * x);  // above its lowest
    if (ground.height_m[i] - rim_m <= wheel.height_m) continue;
    wheel.height_m = ground.height_m[i] - rim_m;
    wheel.triangle = ground.triangle[i];
  }
}

void find_step(const Ground& ground, WheelGround& wheel) {
  for (int behind = 0; behind + 2 * kSide < kRays; ++behind) {
    const int ahead = behind + 2 * kSide;
    const double rise = ground.height_m[ahead] - ground.height_m[behind];
    if (!std::isfinite(rise) || std::abs(rise) <= wheel.step_m) continue;
    wheel.step_m = std::abs(rise);
    wheel.step_triangle = ground.triangle[rise > 0.0 ? ahead : behind];
  }
}

}  // namespace

WheelGroundProbe::WheelGroundProbe(const RayScene& scene, const Vehicle& vehicle)
    : scene_(scene),
      wheel_radius_m_(vehicle.wheel_radius_m),
      wheel_width_m_(vehicle.wheel_width_m) {}

std::optional<WheelGround> WheelGroundProbe::under(const WheelPlace& place) const {
  const Pose2 T_world_wheel{place.p_world.x(), place.p_world.y(), place.heading_rad};
  std::array<Ray, kRays> rays;
  for (int i = 0; i < kRays; ++i) {
    const double x = along(i) * kSpacing * wheel_radius_m_;
    const double y = across(i) * wheel_width_m_ / (kSide - 1);
    const Eigen::Vector2d p_world = T_world_wheel * Eigen::Vector2d(x, y);
    rays[i] = {Eigen::Vector3d(p_world.x(), p_world.y(), place.look_from_m).cast<float>(),
               -Eigen::Vector3f::UnitZ()};
  }
  const Ground ground = look_down(scene_, rays);
  if (!has_ground_below_middle(ground)) return std::nullopt;
  WheelGround wheel{kNone, 0, 0.0, 0};
  rest_on(ground, wheel_radius_m_, wheel);
  find_step(ground, wheel);
  return wheel;
}

}  // namespace adit
