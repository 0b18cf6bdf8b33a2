// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/laser/laser_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "sim/laser/echo.hpp"

namespace adit {
namespace {

constexpr double kIntervalRad = std::numbers::pi / 12.0;  // of the mirror, between knots

/// The centre and a ring of eight points with equal weights have the second moment of a uniform
/// disc if the ring is at three quarters of its radius: 8/9 · (3/4)² = 1/2.
constexpr double kRing = 0.75;

/// A ray offset from the centre of a beam by `across` and `up`, as fractions of the beam's radius.
Ray sub_ray(const LaserParams& params, double angle_rad, double across, double up) {
  const Eigen::Vector3d along(std::cos(angle_rad), std::sin(angle_rad), 0.0);
  const Eigen::Vector3d left(-std::sin(angle_rad), std::cos(angle_rad), 0.0);
  const Eigen::Vector3d aside = across * left + up * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d origin = params.spot_m / 2.0 * aside;
  const Eigen::Vector3d direction = along + std::tan(params.divergence_rad / 2.0) * aside;
  return {origin.cast<float>(), direction.normalized().cast<float>()};
}

std::vector<Ray> rays_of_beam(const LaserParams& params, int beam) {
  const double angle_rad =
      params.bearing_scale * (beam * params.angle_step_rad() - params.field_of_view_rad / 2.0);
  std::vector<Ray> rays{sub_ray(params, angle_rad, 0.0, 0.0)};
  for (int i = 1; i < params.subrays; ++i) {
    const double around = 2.0 * std::numbers::pi * i / (params.subrays - 1);
    rays.push_back(sub_ray(params, angle_rad, kRing * std::cos(around), kRing * std::sin(around)));
  }
  return rays;
}

/// Linear interpolation of the matrices. The poses are so close that the result is a rotation to
/// first order.
Eigen::Affine3f between(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, double share) {
  Eigen::Affine3d T;
  T.matrix() = a.matrix() + share * (b.matrix() - a.matrix());
  return T.cast<float>();
}

}  // namespace

BeamFan::BeamFan(const LaserParams& params)
    : subrays_(static_cast<std::size_t>(params.subrays)),
      intervals_(static_cast<int>(std::ceil(params.field_of_view_rad / kIntervalRad - 1e-9))) {
  if (params.subrays != 1 && params.subrays != 9) {
    throw std::invalid_argument("a beam has 1 or 9 sub-rays");
  }
  const double step_rad = params.angle_step_rad();
  const int turns = params.timing.turns(step_rad);
  for (int turn = 0; turn < turns; ++turn) add_knots(turn, params);
  for (int beam = 0; beam < params.beams; ++beam) {
    add_beam_time(beam % turns, beam * step_rad / params.field_of_view_rad);
    const std::vector<Ray> rays = rays_of_beam(params, beam);
    rays_laser_.insert(rays_laser_.end(), rays.begin(), rays.end());
  }
  rays_world_.resize(rays_laser_.size());
}

void BeamFan::add_knots(int turn, const LaserParams& params) {
  const double view_turns = params.field_of_view_rad / (2.0 * std::numbers::pi);
  for (int i = 0; i <= intervals_; ++i) {
    knot_times_s_.push_back((turn + view_turns * i / intervals_) / params.timing.mirror_hz);
  }
}

void BeamFan::add_beam_time(int turn, double share_of_view) {
  const double place = intervals_ * share_of_view;
  const int interval = std::min(static_cast<int>(place), intervals_ - 1);
  const int knot = turn * (intervals_ + 1) + interval;
  beam_times_.push_back({static_cast<std::size_t>(knot), place - interval});
}

const std::vector<Ray>& BeamFan::rays(const PoseAt& T_world_laser) {
  std::vector<Eigen::Isometry3d> knots;
  for (const double seconds : knot_times_s_) knots.push_back(T_world_laser(seconds));
  for (std::size_t beam = 0; beam < beam_times_.size(); ++beam) {
    const auto& [knot, share] = beam_times_[beam];
    const Eigen::Affine3f T = between(knots[knot], knots[knot + 1], share);
    for (std::size_t i = beam * subrays_; i < (beam + 1) * subrays_; ++i) {
      rays_world_[i].origin = T * rays_laser_[i].origin;
      rays_world_[i].direction = T.linear() * rays_laser_[i].direction;
    }
  }
  return rays_world_;
}

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

LaserModel::LaserModel(const RayScene& scene, const LaserParams& params, std::uint64_t seed)
    : scene_(scene), params_(params), random_(seed), fan_(params) {
  offset_m_ =
      std::uniform_real_distribution<double>(-params.offset_max_m, params.offset_max_m)(random_);
  power_min_ = power(kReferenceReflectivity, 1.0, params.range_at_10_percent_m);
  ray_length_m_ = static_cast<float>(
      std::min(params.no_return_m(), std::sqrt(params.subrays * reflectivity_max() / power_min_)));
}

LaserScan LaserModel::measure(const PoseAt& T_world_laser, std::int64_t utime) {
  const std::span<const Ray> rays = fan_.rays(T_world_laser);
  hits_.resize(rays.size());
  scene_.cast(rays, ray_length_m_, hits_);
  LaserScan scan{utime, {}, -params_.field_of_view_rad / 2.0, params_.angle_step_rad()};
  scan.ranges_m.reserve(static_cast<std::size_t>(params_.beams));
  const auto n = static_cast<std::size_t>(params_.subrays);
  for (std::size_t i = 0; i < rays.size(); i += n) {
    // Drawn for each beam, hit or not, so that a change of the world does not change the noise of
    // other beams.
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
      merge_echoes(std::span(echoes).first(n), params_.pulse_length_m, params_.first_echo_share);
  if (!seen || seen->power < power_min_ * params_.subrays) return std::nullopt;
  return seen->range_m;
}

std::optional<Echo> LaserModel::echo(const Ray& ray, const RayHit& hit) const {
  if (!std::isfinite(hit.distance_m)) return std::nullopt;
  const Material material = scene_.mesh().part_of(hit.triangle).material;
  if (material == Material::kWater) return std::nullopt;
  if (material == Material::kMirror) return specular_echo(ray, hit);
  return Echo{hit.distance_m,
              power(reflectivity(material), cos_incidence(ray, hit), hit.distance_m)};
}

/// Echo of the surface seen in the mirror, at the range along the reflected path. Echoes by a
/// second mirror are too weak to be detected.
std::optional<Echo> LaserModel::specular_echo(const Ray& ray, const RayHit& mirror) const {
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

float LaserModel::reading_m(std::optional<double> range_m, double noise_m) const {
  const double no_return = params_.no_return_m();
  if (!range_m) return static_cast<float>(no_return);
  const double measured = *range_m + offset_m_ + noise_m;
  if (measured < params_.range_min_m || measured >= no_return) return static_cast<float>(no_return);
  return static_cast<float>(std::round(measured / params_.unit_m) * params_.unit_m);
}

}  // namespace adit
