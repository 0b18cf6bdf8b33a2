// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/laser/range_finder.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace adit {
namespace {

constexpr double kReferenceReflectivity = 0.1;
constexpr std::size_t kSubraysMax = 9;
// Offset of a reflected ray from the mirror, so that it does not hit the mirror again [m].
constexpr float kOffMirror = 0.01F;

double power(double reflectivity, double cos_incidence, double range_m) {
  return reflectivity * cos_incidence / (range_m * range_m);
}

double cos_incidence(const Ray& ray, const RayHit& hit) { return -ray.direction.dot(hit.normal); }

}  // namespace

RangeFinder::RangeFinder(const RayScene& scene, const LaserParams& params)
    : scene_(scene), params_(params) {
  power_min_ = power(kReferenceReflectivity, 1.0, params.range_at_10_percent_m);
  ray_length_m_ = static_cast<float>(
      std::min(params.no_return_m(), std::sqrt(params.subrays * reflectivity_max() / power_min_)));
}

std::optional<double> RangeFinder::range_m(std::span<const Ray> rays,
                                           std::span<const RayHit> hits) const {
  std::array<Echo, kSubraysMax> echoes;
  std::size_t n = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (const auto one = echo(rays[i], hits[i])) echoes[n++] = *one;
  }
  const auto seen =
      merge_echoes(std::span(echoes).first(n), params_.pulse_length_m, params_.first_echo_share);
  if (!seen || seen->power < power_min_ * params_.subrays) return std::nullopt;
  return seen->range_m;
}

std::optional<Echo> RangeFinder::echo(const Ray& ray, const RayHit& hit) const {
  if (!std::isfinite(hit.distance_m)) return std::nullopt;
  const Material material = scene_.mesh().part_of(hit.triangle).material;
  if (material == Material::kWater) return std::nullopt;
  if (material == Material::kMirror) return specular_echo(ray, hit);
  return Echo{hit.distance_m,
              power(reflectivity(material), cos_incidence(ray, hit), hit.distance_m)};
}

/// Echo of the surface seen in the mirror, at the range along the reflected path. Echoes by a
/// second mirror are too weak to be detected.
std::optional<Echo> RangeFinder::specular_echo(const Ray& ray, const RayHit& mirror) const {
  const float cosine = -ray.direction.dot(mirror.normal);
  const Eigen::Vector3f away = ray.direction + 2.0F * cosine * mirror.normal;
  const float behind_m = mirror.distance_m + kOffMirror;
  const Ray reflected{ray.origin + mirror.distance_m * ray.direction + kOffMirror * away, away};
  const auto hit = scene_.cast(reflected, ray_length_m_ - behind_m);
  if (!hit) return std::nullopt;
  const double rho = reflectivity(scene_.mesh().part_of(hit->triangle).material);
  if (rho == 0.0) return std::nullopt;
  const double share = specular_share(cosine);  // on both passes of the mirror
  const double range = static_cast<double>(behind_m) + hit->distance_m;
  return Echo{range, share * share * power(rho, cos_incidence(reflected, *hit), range)};
}

float RangeFinder::reading_m(std::optional<double> range_m, double error_m) const {
  const double no_return = params_.no_return_m();
  if (!range_m) return static_cast<float>(no_return);
  const double measured = *range_m + error_m;
  if (measured < params_.range_min_m || measured >= no_return) return static_cast<float>(no_return);
  return static_cast<float>(std::round(measured / params_.unit_m) * params_.unit_m);
}

}  // namespace adit
