// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/wall_agreement.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

namespace adit {
namespace {

/// A view of the free space, ready for points of the reference.
struct PlacedView {
  const FreeSpace* free_space;
  Eigen::Matrix2d R_laser_reference;
  Eigen::Vector2d p_laser_reference;

  explicit PlacedView(const LocalWalls::View& view) : free_space(&view.free_space) {
    const Pose2 T = view.free_space.body_in_laser() * view.T_local_body.inverse();
    R_laser_reference = Eigen::Rotation2Dd(T.theta).toRotationMatrix();
    p_laser_reference = T.translation();
  }

  [[nodiscard]] bool sees_through(const Eigen::Vector2d& p, double margin) const {
    return free_space->inside(R_laser_reference * p + p_laser_reference, margin);
  }
};

double distance_from(const Surfel& wall, const Eigen::Vector2d& p) {
  return wall.has_normal() ? std::abs(wall.normal.dot(p - wall.p)) : (p - wall.p).norm();
}

/// Log of how much more likely a distance from the wall is where maps coincide than by chance.
double log_ratio(double distance, const WallAgreementParams& params) {
  const double u = distance / params.wall_sd_m;
  const double on_wall = std::exp(-0.5 * u * u) * 2.0 * params.reach_m /
                         (params.wall_sd_m * std::sqrt(2.0 * std::numbers::pi));
  return std::log((1.0 - params.stray_share) * on_wall + params.stray_share);
}

}  // namespace

WallAgreement agreement(const std::vector<SurfacePoint>& points, const Pose2& T_reference_points,
                        const SurfelMap& reference, const std::vector<LocalWalls::View>& views,
                        const WallAgreementParams& params) {
  const Eigen::Matrix2d R = Eigen::Rotation2Dd(T_reference_points.theta).toRotationMatrix();
  const std::vector<PlacedView> placed(views.begin(), views.end());
  const double log_near =
      std::log((1.0 - params.contradiction) / (1.0 - params.contradiction_by_chance));
  const double log_contradiction = std::log(params.contradiction / params.contradiction_by_chance);
  WallAgreement result;
  result.points = static_cast<int>(points.size());
  for (const SurfacePoint& point : points) {
    const Eigen::Vector2d p = R * point.p + T_reference_points.translation();
    const Surfel* wall = reference.nearest(p, R * point.normal, params.reach_m).surfel;
    if (wall != nullptr) {
      ++result.near;
      result.log_likelihood += log_near + log_ratio(distance_from(*wall, p), params);
    } else if (std::any_of(placed.begin(), placed.end(), [&](const PlacedView& view) {
                 return view.sees_through(p, params.margin_m);
               })) {
      ++result.contradicting;
      result.log_likelihood += log_contradiction;
    }
  }
  return result;
}

}  // namespace adit
