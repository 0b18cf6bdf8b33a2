// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/goals/connecting_curve.hpp"

#include <algorithm>
#include <cmath>

#include "common/geometry/segment.hpp"

namespace adit {
namespace {

constexpr int kCurvatureSamples = 20;  // at which the curvature is checked

Eigen::Vector2d heading_of(const Pose2& pose) {
  return {std::cos(pose.theta), std::sin(pose.theta)};
}

/// The curve over its parameter, 0 to 1, with tangents as long as the chord.
struct HermiteCurve {
  Eigen::Vector2d from;
  Eigen::Vector2d to;
  Eigen::Vector2d tangent_from;
  Eigen::Vector2d tangent_to;

  [[nodiscard]] Eigen::Vector2d at(double t) const {
    const double u = 1.0 - t;
    return u * u * (1.0 + 2.0 * t) * from + t * t * (3.0 - 2.0 * t) * to +
           t * u * u * tangent_from - t * t * u * tangent_to;
  }
  [[nodiscard]] Eigen::Vector2d velocity(double t) const {
    const double u = 1.0 - t;
    return 6.0 * t * u * (to - from) + u * (1.0 - 3.0 * t) * tangent_from +
           t * (3.0 * t - 2.0) * tangent_to;
  }
  [[nodiscard]] Eigen::Vector2d acceleration(double t) const {
    return (6.0 - 12.0 * t) * (to - from) + (6.0 * t - 4.0) * tangent_from +
           (6.0 * t - 2.0) * tangent_to;
  }
  /// Whether it leads towards its end there, with at least this radius.
  [[nodiscard]] bool is_drivable(double radius_min_m, double t) const {
    const double speed = velocity(t).norm();
    const double turn = std::abs(cross(velocity(t), acceleration(t)));
    return velocity(t).dot(to - from) > 0.0 && turn * radius_min_m <= speed * speed * speed;
  }
};

}  // namespace

std::vector<Pose2> connecting_curve(const Pose2& T_from, const Pose2& T_to, double radius_min_m,
                                    double spacing_m) {
  const Pose2 step = between(T_from, T_to);
  const double chord_m = step.translation().norm();
  if (chord_m == 0.0) return {};
  const double direction = step.x < 0.0 ? -1.0 : 1.0;
  const HermiteCurve curve{T_from.translation(), T_to.translation(),
                           direction * chord_m * heading_of(T_from),
                           direction * chord_m * heading_of(T_to)};
  for (int i = 0; i <= kCurvatureSamples; ++i) {
    if (!curve.is_drivable(radius_min_m, static_cast<double>(i) / kCurvatureSamples)) return {};
  }
  const int poses = std::max(1, static_cast<int>(std::ceil(chord_m / spacing_m)));
  std::vector<Pose2> path;
  for (int i = 1; i < poses; ++i) {
    const double t = static_cast<double>(i) / poses;
    const Eigen::Vector2d p = curve.at(t);
    const Eigen::Vector2d ahead = direction * curve.velocity(t);
    path.push_back({p.x(), p.y(), std::atan2(ahead.y(), ahead.x())});
  }
  path.push_back(T_to);
  return path;
}

}  // namespace adit
