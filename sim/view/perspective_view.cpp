// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/view/perspective_view.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "sim/view/render.hpp"
#include "sim/view/shading.hpp"

namespace adit {

Camera::Camera(const Eigen::Isometry3d& T_world_camera, double field_of_view_rad, int width,
               int height)
    : T_world_camera_(T_world_camera),
      width_(width),
      height_(height),
      focal_length_px_(width / 2.0 / std::tan(field_of_view_rad / 2.0)) {}

Ray Camera::ray(const Eigen::Vector2d& uv) const {
  const Eigen::Vector3d d_camera(focal_length_px_, width_ / 2.0 - uv.x(), height_ / 2.0 - uv.y());
  const Eigen::Vector3d d_world = T_world_camera_.linear() * d_camera.normalized();
  return {eye().cast<float>(), d_world.cast<float>()};
}

std::optional<Eigen::Vector2d> Camera::pixel(const Eigen::Vector3d& p_world) const {
  const Eigen::Vector3d p_camera = T_world_camera_.inverse() * p_world;
  if (p_camera.x() <= 0.0) return std::nullopt;
  const double scale = focal_length_px_ / p_camera.x();
  return Eigen::Vector2d(width_ / 2.0 - scale * p_camera.y(), height_ / 2.0 - scale * p_camera.z());
}

namespace {

constexpr float kRangeMax = 5000.0F;     // [m]
constexpr double kStepBack = 2.0;        // [m]
constexpr double kWallDistance = 0.5;    // that the camera keeps [m]
constexpr float kLampReach = 9.0F;       // at which its light has fallen to a half [m]
constexpr float kLampPower = 1.5F;       // as linear light on white, close by
constexpr float kFillPower = 0.25F;      // of the light from the eye itself
constexpr float kAmbient = 0.09F;        // from all around
constexpr float kOcclusionReach = 0.5F;  // [m]
constexpr float kFogDepth = 35.0F;       // in which the fog takes all but 1/e [m]
const Rgb kFog = linear(0x23282f);
const Rgb kDay = linear(0xd5dfe8);

/// Height of the floor, or 0 where it is unknown.
double floor_at(const World& world, const Eigen::Vector2d& p_world) {
  return world.truth.floor_at(p_world).value_or(0.0);
}

Pose2 behind_start(const Site& site, double eye_m) {
  const Pose2& start = site.world().T_world_start;
  const double z = floor_at(site.world(), start.translation()) + eye_m;
  const Eigen::Vector3d back(-std::cos(start.theta), -std::sin(start.theta), 0.0);
  const Ray ray{Eigen::Vector3d(start.x, start.y, z).cast<float>(), back.cast<float>()};
  const auto hit = site.scene().cast(ray, static_cast<float>(kStepBack + kWallDistance));
  const double room = hit ? std::max(0.0, hit->distance_m - kWallDistance) : kStepBack;
  return start * Pose2{-std::min(kStepBack, room), 0.0, 0.0};
}

/// Position of the lamp: above and to the left of the camera, so that shadows are visible; at the
/// camera if there is no free space.
Eigen::Vector3f lamp_of(const RayScene& scene, const Camera& camera) {
  const Eigen::Vector3d beside = camera.T_world_camera().linear() * Eigen::Vector3d(0.0, 0.45, 0.3);
  const Ray ray{camera.eye().cast<float>(), beside.normalized().cast<float>()};
  const auto reach = static_cast<float>(beside.norm());
  if (scene.cast(ray, reach + 0.1F)) return ray.origin;
  return ray.origin + beside.cast<float>();
}

/// For each point, whether the lamp illuminates it.
std::vector<bool> lit_by(const RayScene& scene, const Eigen::Vector3f& lamp,
                         const std::vector<ShadedPoint>& points) {
  std::vector<Ray> rays;
  rays.reserve(points.size());
  for (const ShadedPoint& point : points) {
    rays.push_back({lamp, (point.p_world - lamp).normalized()});
  }
  std::vector<RayHit> hits(rays.size());
  scene.cast(rays, kRangeMax, hits);
  std::vector<bool> lit(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    // The point lies slightly in front of its surface; at a grazing angle the offset is much
    // smaller.
    lit[i] = hits[i].distance_m > (points[i].p_world - lamp).norm() - 1e-3F;
  }
  return lit;
}

float fall_off(float distance_m) {
  const float share = distance_m / kLampReach;
  return 1.0F / (1.0F + share * share);
}

/// Specular reflection of steel and water (Blinn and Phong).
float gloss(Material material, const ShadedPoint& point, const Eigen::Vector3f& to_lamp,
            const Eigen::Vector3f& to_eye) {
  if (material != Material::kSteel && material != Material::kWater && material != Material::kMirror)
    return 0.0F;
  return 0.5F * std::pow(std::max(0.0F, point.normal.dot((to_lamp + to_eye).normalized())), 24.0F);
}

/// Total light from a point to the camera.
struct Lighting {
  Eigen::Vector3f eye;
  Eigen::Vector3f lamp;

  [[nodiscard]] Rgb seen(const Part& part, const ShadedPoint& point, bool lit,
                         float openness) const {
    const Eigen::Vector3f to_lamp = (lamp - point.p_world).normalized();
    const Eigen::Vector3f to_eye = (eye - point.p_world).normalized();
    const float distance = (point.p_world - eye).norm();
    const float fall = fall_off(distance);
    const float direct = lit ? kLampPower * fall * std::max(0.0F, point.normal.dot(to_lamp)) : 0.0F;
    const float fill = kFillPower * fall * std::max(0.0F, point.normal.dot(to_eye));
    const float shine = lit ? fall * gloss(part.material, point, to_lamp, to_eye) : 0.0F;
    const float around = kAmbient * openness;
    const float occluded = 0.4F + 0.6F * openness;
    const Rgb light = (occluded * (direct + fill) + around) * colour_at(part, point.p_world) +
                      Rgb::Constant(shine);
    const float clear = std::exp(-distance / kFogDepth);
    return clear * light + (1.0F - clear) * kFog;
  }
};

}  // namespace

Camera camera_of(const Site& site, const ViewOptions& options, int width, int height) {
  const Pose2 at = options.from.value_or(behind_start(site, options.eye_m));
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  T_world_camera.translation() << at.x, at.y,
      floor_at(site.world(), at.translation()) + options.eye_m;
  T_world_camera.rotate(Eigen::AngleAxisd(at.theta, Eigen::Vector3d::UnitZ()));
  T_world_camera.rotate(Eigen::AngleAxisd(options.pitch_rad, Eigen::Vector3d::UnitY()));
  return {T_world_camera, options.field_of_view_rad, width, height};
}

RgbImage perspective_view(const RayScene& scene, const Camera& camera) {
  const Lighting lighting{camera.eye().cast<float>(), lamp_of(scene, camera)};
  const auto paint = [&](std::span<const Eigen::Vector2d> samples, std::span<Rgb> light) {
    std::vector<Ray> rays;
    rays.reserve(samples.size());
    for (const Eigen::Vector2d& uv : samples) rays.push_back(camera.ray(uv));
    std::vector<RayHit> hits(rays.size());
    scene.cast(rays, kRangeMax, hits);
    std::vector<ShadedPoint> points(rays.size(), {lighting.eye, Eigen::Vector3f::UnitZ()});
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (std::isfinite(hits[i].distance_m)) points[i] = shaded_point(rays[i], hits[i]);
    }
    const std::vector<bool> lit = lit_by(scene, lighting.lamp, points);
    std::vector<float> openness(points.size());
    find_openness(scene, points, kOcclusionReach, openness);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      light[i] = std::isinf(hits[i].distance_m)
                     ? kDay
                     : lighting.seen(scene.mesh().part_of(hits[i].triangle), points[i], lit[i],
                                     openness[i]);
    }
  };
  return render(camera.width(), camera.height(), paint);
}

}  // namespace adit
