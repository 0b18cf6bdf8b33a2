// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/guard/arc_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace adit {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kStraight = 1e-5;  // of curvature [1/m]: 0.02 mm beside the line after two metres
constexpr double kRounding = 1e-9;  // by which a point on an edge may seem to be past it [rad]

double clamped_curvature(const Vehicle& vehicle, double curvature_1_m) {
  const double max = 1.0 / vehicle.turning_radius_m;
  return std::clamp(curvature_1_m, -max, max);
}

Eigen::Vector2d centre_of_turn(const Vehicle& vehicle, double curvature_1_m) {
  const double x = vehicle.steering == "ackermann" ? -0.5 * vehicle.wheelbase_m : 0.0;
  const double radius = 1.0 / curvature_1_m;
  const double y = std::sqrt(std::max(0.0, radius * radius - x * x));
  return {x, std::copysign(y, curvature_1_m)};
}

}  // namespace

ArcSweep::ArcSweep(const Vehicle& vehicle, const ArcMotion& motion, double side_margin_m)
    : direction_(std::copysign(1.0, motion.speed_m_s)),
      curvature_1_m_(clamped_curvature(vehicle, motion.curvature_1_m)),
      straight_(std::abs(curvature_1_m_) < kStraight) {
  if (!straight_) centre_ = centre_of_turn(vehicle, curvature_1_m_);
  bare_ = rectangle(0.5 * vehicle.length_m, 0.5 * vehicle.width_m);
  wide_ = rectangle(bare_.x_m, bare_.y_m + side_margin_m);
}

bool ArcSweep::Rectangle::holds(const Eigen::Vector2d& p_body) const {
  return std::abs(p_body.x()) <= x_m && std::abs(p_body.y()) <= y_m;
}

ArcSweep::Rectangle ArcSweep::rectangle(double x_m, double y_m) const {
  const Eigen::Vector2d half(x_m, y_m);
  const double near = (centre_ - centre_.cwiseMax(-half).cwiseMin(half)).norm();
  const double far = (centre_.cwiseAbs() + half).norm();
  return {x_m, y_m, near, far};
}

double ArcSweep::way_m(const Eigen::Vector2d& p_body) const {
  if (bare_.holds(p_body)) return p_body.x() * direction_ > 0.0 ? 0.0 : kNever;
  const Rectangle& footprint = wide_.holds(p_body) ? bare_ : wide_;
  return straight_ ? straight_way_m(p_body, footprint) : way_m(p_body, footprint);
}

double ArcSweep::reach_m(double way_m) const {
  const double farthest_moves_m =
      straight_ ? way_m : way_m * std::abs(curvature_1_m_) * wide_.radius_max_m;
  return std::hypot(wide_.x_m, wide_.y_m) + farthest_moves_m;
}

double ArcSweep::straight_way_m(const Eigen::Vector2d& p_body, const Rectangle& footprint) const {
  const double ahead_m = p_body.x() * direction_ - footprint.x_m;
  return std::abs(p_body.y()) <= footprint.y_m && ahead_m >= 0.0 ? ahead_m : kNever;
}

double ArcSweep::way_m(const Eigen::Vector2d& p_body, const Rectangle& footprint) const {
  const Eigen::Vector2d from = p_body - centre_;
  const double radius = from.norm();
  if (radius < footprint.radius_min_m || radius > footprint.radius_max_m) return kNever;
  double turn = kNever;
  const auto cross = [&](int axis, double edge, double other_half_m) {
    const double along = edge - centre_[axis];
    const double across = std::sqrt(radius * radius - along * along);  // NaN: never
    for (const double side : {across, -across}) {
      if (!(std::abs(side + centre_[1 - axis]) <= other_half_m)) continue;
      Eigen::Vector2d to;
      to[axis] = along;
      to[1 - axis] = side;
      turn = std::min(turn, turn_rad(from, to));
    }
  };
  for (const double sign : {1.0, -1.0}) {
    cross(0, sign * footprint.x_m, footprint.y_m);
    cross(1, sign * footprint.y_m, footprint.x_m);
  }
  return turn / std::abs(curvature_1_m_);
}

/// From one place on the circle to another, the way that points go: 0 to a full turn.
double ArcSweep::turn_rad(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const {
  const double left = std::atan2(from.x() * to.y() - from.y() * to.x(), from.dot(to));
  const double turn = direction_ * curvature_1_m_ > 0.0 ? -left : left;
  return turn < -kRounding ? turn + kTurn : std::max(0.0, turn);
}

}  // namespace adit
