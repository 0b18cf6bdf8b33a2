// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/laser/laser_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "sim/laser/reflectance.hpp"

namespace adit {
namespace {

constexpr double kReflectivityOfBlack = 0.1;
constexpr std::size_t kSubraysMax = 9;
// How far along its way a ray that a mirror reflects begins, so as not to meet the mirror again
// [m].
constexpr float kOffMirror = 0.01F;

double power(double reflectivity, double cos_incidence, double range_m) {
  return reflectivity * cos_incidence / (range_m * range_m);
}

double cos_incidence(const Ray& ray, const RayHit& hit) { return -ray.direction.dot(hit.normal); }

}  // namespace

LaserModel::LaserModel(const RayScene& scene, const LaserParams& params, std::uint64_t seed)
    : scene_(scene), params_(params), random_(seed), fan_(params) {
  offset_m_ =
      std::uniform_real_distribution<double>(-params.offset_max_m, params.offset_max_m)(random_);
  power_min_ = power(kReflectivityOfBlack, 1.0, params.range_of_black_m);
  ray_length_m_ = static_cast<float>(
      std::min(params.no_return_m(), std::sqrt(params.subrays * reflectivity_max() / power_min_)));
}

LaserScan LaserModel::measure(const PoseAt& T_world_laser, std::int64_t utime) {
  const std::span<const Ray> rays = fan_.rays(T_world_laser);
  hits_.resize(rays.size());
  scene_.cast(rays, ray_length_m_, hits_);
  LaserScan scan{utime, {}, -std::numbers::pi / 2.0, params_.angle_step_rad()};
  scan.ranges_m.reserve(static_cast<std::size_t>(params_.beams));
  const auto n = static_cast<std::size_t>(params_.subrays);
  for (std::size_t i = 0; i < rays.size(); i += n) {
    // Drawn whatever the beam meets, so that the others keep their noise where a world changes.
    const double noise_m = params_.noise_sd_m * normal_(random_);
    const auto range = range_m(rays.subspan(i, n), std::span(hits_).subspan(i, n));
    scan.ranges_m.push_back(reading_m(range, noise_m));
  }
  return scan;
}

std::optional<double> LaserModel::range_m(std::span<const Ray> rays,
                                          std::span<const RayHit> hits) const {
  std::array<Echo, kSubraysMax> echoes;
  std::size_t n = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (const auto one = echo(rays[i], hits[i])) echoes[n++] = *one;
  }
  const auto seen =
      seen_as_one(std::span(echoes).first(n), params_.pulse_length_m, params_.first_share);
  if (!seen || seen->power < power_min_ * params_.subrays) return std::nullopt;
  return seen->range_m;
}

std::optional<Echo> LaserModel::echo(const Ray& ray, const RayHit& hit) const {
  if (!std::isfinite(hit.distance_m)) return std::nullopt;
  const Material material = scene_.mesh().part_of(hit.triangle).material;
  if (material == Material::kWater) return std::nullopt;
  if (material == Material::kMirror) return mirrored_echo(ray, hit);
  return Echo{hit.distance_m,
              power(reflectivity(material), cos_incidence(ray, hit), hit.distance_m)};
}

/// From the image of what the mirror shows, as far behind it as that is before it. What a second
/// mirror would show is too faint.
std::optional<Echo> LaserModel::mirrored_echo(const Ray& ray, const RayHit& mirror) const {
  const float cosine = -ray.direction.dot(mirror.normal);
  const Eigen::Vector3f away = ray.direction + 2.0F * cosine * mirror.normal;
  const float behind_m = mirror.distance_m + kOffMirror;
  const Ray reflected{ray.origin + mirror.distance_m * ray.direction + kOffMirror * away, away};
  const auto hit = scene_.cast(reflected, ray_length_m_ - behind_m);
  if (!hit) return std::nullopt;
  const double rho = reflectivity(scene_.mesh().part_of(hit->triangle).material);
  if (rho == 0.0) return std::nullopt;
  const double share = mirrored_share(cosine);  // on the way there, and again on the way back
  const double range = static_cast<double>(behind_m) + hit->distance_m;
  return Echo{range, share * share * power(rho, cos_incidence(reflected, *hit), range)};
}

float LaserModel::reading_m(std::optional<double> range_m, double noise_m) const {
  const double no_return = params_.no_return_m();
  if (!range_m) return static_cast<float>(no_return);
  const double measured = *range_m + offset_m_ + noise_m;
  if (measured < params_.range_min_m || measured >= no_return) return static_cast<float>(no_return);
  return static_cast<float>(std::round(measured / params_.unit_m) * params_.unit_m);
}

}  // namespace adit
