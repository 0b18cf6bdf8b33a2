// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/pose.hpp"

#include <algorithm>
#include <limits>

#include "common/messages/checks.hpp"

namespace adit {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

void set_velocity(const std::optional<Eigen::Vector3d>& v_body, pose_t& message) {
  std::fill(std::begin(message.vel), std::end(message.vel), kUnknown);
  std::fill(std::begin(message.rotation_rate), std::end(message.rotation_rate), kUnknown);
  if (!v_body) return;
  message.vel[0] = v_body->x();
  message.vel[1] = v_body->y();
  message.rotation_rate[2] = v_body->z();
}

std::optional<Eigen::Vector3d> velocity(const pose_t& message) {
  const Eigen::Vector3d v_body(message.vel[0], message.vel[1], message.rotation_rate[2]);
  return v_body.allFinite() ? std::optional(v_body) : std::nullopt;
}

}  // namespace

pose_t to_message(const StampedPose& pose) {
  pose_t message{};
  message.utime = pose.utime;
  message.pos[0] = pose.T_odom_body.x;
  message.pos[1] = pose.T_odom_body.y;
  message.orientation[0] = std::cos(pose.T_odom_body.theta / 2.0);
  message.orientation[3] = std::sin(pose.T_odom_body.theta / 2.0);
  set_velocity(pose.v_body, message);
  std::fill(std::begin(message.accel), std::end(message.accel), kUnknown);
  return message;
}

Result<StampedPose> from_message(const pose_t& message) {
  if (!is_plausible_utime(message.utime)) return Refused{kImplausibleTime};
  if (!all_finite(message.pos)) return Refused{"position is not finite"};
  const Eigen::Vector4d q(message.orientation);
  if (!(std::abs(q.norm() - 1.0) < 1e-3)) return Refused{"orientation is no unit quaternion"};

  // The body's x axis in odom, seen from above.
  const double x = q[0] * q[0] + q[1] * q[1] - q[2] * q[2] - q[3] * q[3];
  const double y = 2.0 * (q[1] * q[2] + q[0] * q[3]);
  if (std::hypot(x, y) < 1e-6) return Refused{"orientation has no heading"};
  return StampedPose{
      message.utime, {message.pos[0], message.pos[1], std::atan2(y, x)}, velocity(message)};
}

}  // namespace adit
