// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/laser/laser_model.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

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

LaserModel::LaserModel(const RayScene& scene, const LaserParams& params, std::uint64_t seed)
    : scene_(scene), params_(params), finder_(scene, params), random_(seed), fan_(params) {
  offset_m_ =
      std::uniform_real_distribution<double>(-params.offset_max_m, params.offset_max_m)(random_);
}

LaserScan LaserModel::measure(const PoseAt& T_world_laser, std::int64_t utime) {
  const std::span<const Ray> rays = fan_.rays(T_world_laser);
  hits_.resize(rays.size());
  scene_.cast(rays, finder_.ray_length_m(), hits_);
  LaserScan scan{utime, {}, -params_.field_of_view_rad / 2.0, params_.angle_step_rad()};
  scan.ranges_m.reserve(static_cast<std::size_t>(params_.beams));
  const auto n = static_cast<std::size_t>(params_.subrays);
  for (std::size_t i = 0; i < rays.size(); i += n) {
    // Drawn for each beam, hit or not, so that a change of the world does not change the noise of
    // other beams.
    const double noise_m = params_.noise_sd_m * normal_(random_);
    const auto range = finder_.range_m(rays.subspan(i, n), std::span(hits_).subspan(i, n));
    scan.ranges_m.push_back(finder_.reading_m(range, offset_m_ + noise_m));
  }
  return scan;
}

}  // namespace adit
