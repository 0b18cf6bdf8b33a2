// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <numbers>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace adit {

/// Wraps an angle to (−π, π]. [rad]
inline double wrap_angle(double angle) {
  const double wrapped = std::remainder(angle, 2.0 * std::numbers::pi);
  return wrapped <= -std::numbers::pi ? std::numbers::pi : wrapped;
}

/// `a − b` wrapped to (−π, π]. All differences of angles use this function. [rad]
inline double angle_diff(double a, double b) { return wrap_angle(a - b); }

constexpr double deg_to_rad(double degrees) { return degrees * std::numbers::pi / 180.0; }
constexpr double rad_to_deg(double radians) { return radians * 180.0 / std::numbers::pi; }

/// A rigid motion of the plane, an element of SE(2). `T_a_b` is the pose of frame b in frame a; it
/// transforms coordinates in b to coordinates in a, so that neighbours cancel: `T_map_body =
/// T_map_odom * T_odom_body`. The product is the composition ξ ⊕ δ of the paper's eq. 1 (the signs
/// printed there rotate by −θ).
struct Pose2 {
  double x = 0.0;      ///< [m]
  double y = 0.0;      ///< [m]
  double theta = 0.0;  ///< [rad], wrapped only in results of the operations below

  [[nodiscard]] Eigen::Vector2d translation() const { return {x, y}; }
  [[nodiscard]] Eigen::Vector3d vector() const { return {x, y, theta}; }

  [[nodiscard]] static Pose2 from_vector(const Eigen::Vector3d& v) {
    return {v.x(), v.y(), wrap_angle(v.z())};
  }

  [[nodiscard]] Pose2 inverse() const {
    const double c = std::cos(theta);
    const double s = std::sin(theta);
    return {-c * x - s * y, s * x - c * y, wrap_angle(-theta)};
  }

  friend Pose2 operator*(const Pose2& T_a_b, const Pose2& T_b_c) {
    const double c = std::cos(T_a_b.theta);
    const double s = std::sin(T_a_b.theta);
    return {T_a_b.x + c * T_b_c.x - s * T_b_c.y, T_a_b.y + s * T_b_c.x + c * T_b_c.y,
            wrap_angle(T_a_b.theta + T_b_c.theta)};
  }

  /// Transforms a point from b to a.
  friend Eigen::Vector2d operator*(const Pose2& T_a_b, const Eigen::Vector2d& p_b) {
    const double c = std::cos(T_a_b.theta);
    const double s = std::sin(T_a_b.theta);
    return {T_a_b.x + c * p_b.x() - s * p_b.y(), T_a_b.y + s * p_b.x() + c * p_b.y()};
  }

  friend bool operator==(const Pose2&, const Pose2&) = default;
};

/// The pose of b in the frame of a: `T_a_b` from `T_w_a` and `T_w_b`.
inline Pose2 between(const Pose2& T_w_a, const Pose2& T_w_b) { return T_w_a.inverse() * T_w_b; }

/// The adjoint of SE(2): transforms a small motion (x, y, θ) of frame b, expressed in b, to the
/// same motion expressed in frame a, which is rigidly attached to b at `T_a_b`.
inline Eigen::Matrix3d adjoint(const Pose2& T_a_b) {
  const double c = std::cos(T_a_b.theta);
  const double s = std::sin(T_a_b.theta);
  Eigen::Matrix3d Ad;
  Ad << c, -s, T_a_b.y, s, c, -T_a_b.x, 0.0, 0.0, 1.0;
  return Ad;
}

/// Motion along an arc that starts along x, of length `length_m` and turn `turn_rad`. Exact.
inline Pose2 along_arc(double length_m, double turn_rad) {
  // Chord over arc length is sin(t/2)/(t/2); the series is used near zero.
  const double half = 0.5 * turn_rad;
  const double shrink = std::abs(half) < 1e-4 ? 1.0 - half * half / 6.0 : std::sin(half) / half;
  const double chord = length_m * shrink;
  return {chord * std::cos(half), chord * std::sin(half), turn_rad};
}

/// Projects a pose in space to the plane: position seen from above, heading of its x axis.
inline Pose2 in_plan(const Eigen::Isometry3d& T_a_b) {
  const auto& R = T_a_b.linear();
  return {T_a_b.translation().x(), T_a_b.translation().y(), std::atan2(R(1, 0), R(0, 0))};
}

/// A level pose in space from a planar pose and a height [m].
Eigen::Isometry3d in_space(const Pose2& T_a_b, double z_m = 0.0);

}  // namespace adit
