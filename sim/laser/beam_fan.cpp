// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/laser/beam_fan.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace adit {
namespace {

constexpr int kIntervals = 12;  // between knots, in the half turn that beams are measured in

/// A disc evenly lit has the same spread as its middle and a ring of eight, all of equal weight, if
/// the ring is at three quarters of its radius: 8/9 · (3/4)² = 1/2.
constexpr double kRing = 0.75;

/// The ray that leaves a beam's middle at `across` and `up`, both as shares of its radius.
Ray sub_ray(const LaserParams& params, double angle_rad, double across, double up) {
  const Eigen::Vector3d along(std::cos(angle_rad), std::sin(angle_rad), 0.0);
  const Eigen::Vector3d left(-std::sin(angle_rad), std::cos(angle_rad), 0.0);
  const Eigen::Vector3d aside = across * left + up * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d origin = params.spot_m / 2.0 * aside;
  const Eigen::Vector3d direction = along + std::tan(params.divergence_rad / 2.0) * aside;
  return {origin.cast<float>(), direction.normalized().cast<float>()};
}

std::vector<Ray> rays_of_beam(const LaserParams& params, int beam) {
  const double angle_rad = beam * params.angle_step_rad() - std::numbers::pi / 2.0;
  std::vector<Ray> rays{sub_ray(params, angle_rad, 0.0, 0.0)};
  for (int i = 1; i < params.subrays; ++i) {
    const double around = 2.0 * std::numbers::pi * i / (params.subrays - 1);
    rays.push_back(sub_ray(params, angle_rad, kRing * std::cos(around), kRing * std::sin(around)));
  }
  return rays;
}

/// So near to each other that the matrix between is a rotation but for what does not count.
Eigen::Affine3f between(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, double share) {
  Eigen::Affine3d T;
  T.matrix() = a.matrix() + share * (b.matrix() - a.matrix());
  return T.cast<float>();
}

}  // namespace

BeamFan::BeamFan(const LaserParams& params) : subrays_(static_cast<std::size_t>(params.subrays)) {
  if (params.subrays != 1 && params.subrays != 9) {
    throw std::invalid_argument("a beam has 1 or 9 sub-rays");
  }
  const double step_rad = params.angle_step_rad();
  const int turns = params.timing.turns(step_rad);
  for (int turn = 0; turn < turns; ++turn) add_knots(turn, params.timing.mirror_hz);
  for (int beam = 0; beam < params.beams; ++beam) {
    add_beam_time(beam % turns, beam * step_rad / std::numbers::pi);
    const std::vector<Ray> rays = rays_of_beam(params, beam);
    rays_laser_.insert(rays_laser_.end(), rays.begin(), rays.end());
  }
  rays_world_.resize(rays_laser_.size());
}

void BeamFan::add_knots(int turn, double mirror_hz) {
  for (int i = 0; i <= kIntervals; ++i) {
    knot_times_s_.push_back((turn + 0.5 * i / kIntervals) / mirror_hz);
  }
}

void BeamFan::add_beam_time(int turn, double share_of_half_turn) {
  const double place = kIntervals * share_of_half_turn;
  const int interval = std::min(static_cast<int>(place), kIntervals - 1);
  const int knot = turn * (kIntervals + 1) + interval;
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

}  // namespace adit
