// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/mapping/odometry.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "common/messages/fields/mapping_fields.hpp"
#include "common/messages/planar_geometry.hpp"

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
  message.pos[2] = pose.z_m;
  // R_z(heading) · R_y(pitch) · R_x(roll)
  const double cz = std::cos(pose.T_odom_body.theta / 2.0);
  const double sz = std::sin(pose.T_odom_body.theta / 2.0);
  const double cy = std::cos(pose.attitude.pitch_rad / 2.0);
  const double sy = std::sin(pose.attitude.pitch_rad / 2.0);
  const double cx = std::cos(pose.attitude.roll_rad / 2.0);
  const double sx = std::sin(pose.attitude.roll_rad / 2.0);
  message.orientation[0] = cz * cy * cx + sz * sy * sx;
  message.orientation[1] = cz * cy * sx - sz * sy * cx;
  message.orientation[2] = cz * sy * cx + sz * cy * sx;
  message.orientation[3] = sz * cy * cx - cz * sy * sx;
  set_velocity(pose.v_body, message);
  std::fill(std::begin(message.accel), std::end(message.accel), kUnknown);
  return message;
}

Result<StampedPose> from_message(const pose_t& message) {
  if (const auto reason = implausible_field(message); !reason.empty()) return Rejected{reason};
  const Eigen::Vector4d q(message.orientation);
  if (!(std::abs(q.norm() - 1.0) < 1e-3)) return Rejected{"orientation is not a unit quaternion"};

  // The body's x axis in odom, projected onto the plane.
  const double x = q[0] * q[0] + q[1] * q[1] - q[2] * q[2] - q[3] * q[3];
  const double y = 2.0 * (q[1] * q[2] + q[0] * q[3]);
  if (std::hypot(x, y) < 1e-6) return Rejected{"orientation has no heading"};
  // The vertical in the body frame: the last row of the rotation matrix.
  const Eigen::Vector3d up_body(2.0 * (q[1] * q[3] - q[0] * q[2]),
                                2.0 * (q[2] * q[3] + q[0] * q[1]),
                                q[0] * q[0] - q[1] * q[1] - q[2] * q[2] + q[3] * q[3]);
  return StampedPose{message.utime,
                     {message.pos[0], message.pos[1], std::atan2(y, x)},
                     velocity(message),
                     message.pos[2],
                     Attitude::from_up(up_body)};
}

namespace {

using Status = ScanMatch::Status;
using Fill = DegenerateDirection::Fill;

static_assert(static_cast<int>(Status::kFirstScan) == scan_match_t::STATUS_FIRST_SCAN);
static_assert(static_cast<int>(Status::kMatched) == scan_match_t::STATUS_MATCHED);
static_assert(static_cast<int>(Status::kLost) == scan_match_t::STATUS_LOST);
static_assert(static_cast<int>(Status::kRejected) == scan_match_t::STATUS_REJECTED);
static_assert(static_cast<int>(Fill::kNone) == scan_match_t::FILL_NONE);
static_assert(static_cast<int>(Fill::kOdometry) == scan_match_t::FILL_ODOMETRY);
static_assert(static_cast<int>(Fill::kImu) == scan_match_t::FILL_IMU);
static_assert(static_cast<int>(MatchDoubt::Reason::kLost) == match_doubt_t::REASON_LOST);
static_assert(static_cast<int>(MatchDoubt::Reason::kPoor) == match_doubt_t::REASON_POOR);
static_assert(static_cast<int>(MatchDoubt::Reason::kAmbiguous) == match_doubt_t::REASON_AMBIGUOUS);
static_assert(static_cast<int>(MatchDoubt::Reason::kDegenerate) ==
              match_doubt_t::REASON_DEGENERATE);
static_assert(static_cast<int>(MatchDoubt::Reason::kContradicted) ==
              match_doubt_t::REASON_CONTRADICTED);

constexpr double kUnitTolerance = 1e-3;

std::vector<DegenerateDirection> degenerate_directions(const scan_match_t& message) {
  std::vector<DegenerateDirection> directions;
  for (std::size_t i = 0; i < message.degenerate_directions.size(); ++i) {
    directions.push_back({Eigen::Vector3d(message.degenerate_directions[i].data()),
                          DegenerateDirection::Fill(message.degenerate_fills[i])});
  }
  return directions;
}

std::string_view rejection_reason(const scan_match_t& message) {
  if (const auto reason = implausible_field(message); !reason.empty()) return reason;
  for (const std::vector<double>& direction : message.degenerate_directions) {
    const double norm = Eigen::Vector3d(direction.data()).norm();
    if (std::abs(norm - 1.0) > kUnitTolerance) return "degenerate direction is not a unit vector";
  }
  return {};
}

}  // namespace

scan_match_t to_message(const ScanMatch& match) {
  scan_match_t message;
  message.utime = match.utime;
  message.reference_utime = match.reference_utime;
  message.odom_epoch_utime = match.odom_epoch_utime;
  message.channel = match.channel;
  message.status = static_cast<std::int8_t>(match.status);
  set_pose(match.T_odom_body, message.T_odom_body);
  set_pose(match.T_reference_body, message.delta);
  message.z_m = match.z_m;
  set_attitude(match.attitude, match.attitude_from_ground, message);
  message.n_ground_beams = static_cast<std::int32_t>(match.ground_beams.size());
  message.ground_beams.assign(match.ground_beams.begin(), match.ground_beams.end());
  message.n_unconfirmed_beams = static_cast<std::int32_t>(match.unconfirmed_beams.size());
  message.unconfirmed_beams.assign(match.unconfirmed_beams.begin(), match.unconfirmed_beams.end());
  set_matrix(match.covariance, message.covariance);
  message.inlier_share = match.inlier_share;
  message.contradiction_share = match.contradiction_share;
  message.rms_residual_m = match.rms_residual_m;
  message.n_degenerate = static_cast<std::int32_t>(match.degenerate.size());
  for (const DegenerateDirection& degenerate : match.degenerate) {
    const Eigen::Vector3d& d = degenerate.direction;
    message.degenerate_directions.push_back({d.x(), d.y(), d.z()});
    message.degenerate_fills.push_back(static_cast<std::int8_t>(degenerate.fill));
  }
  message.lever_arm_m = match.lever_arm_m;
  message.wheels_scale_sd = match.wheels_scale_sd;
  message.iterations = match.iterations;
  message.searched = static_cast<std::int8_t>(match.searched);
  message.points = match.points;
  return message;
}

Result<ScanMatch> from_message(const scan_match_t& message) {
  if (const auto reason = rejection_reason(message); !reason.empty()) return Rejected{reason};
  ScanMatch match;
  match.utime = message.utime;
  match.reference_utime = message.reference_utime;
  match.odom_epoch_utime = message.odom_epoch_utime;
  match.channel = message.channel;
  match.status = ScanMatch::Status(message.status);
  match.T_odom_body = pose_from(message.T_odom_body);
  match.T_reference_body = pose_from(message.delta);
  match.z_m = message.z_m;
  match.attitude = attitude_from(message);
  match.attitude_from_ground = match.attitude && message.has_attitude == 0;
  match.ground_beams.assign(message.ground_beams.begin(), message.ground_beams.end());
  match.unconfirmed_beams.assign(message.unconfirmed_beams.begin(),
                                 message.unconfirmed_beams.end());
  match.covariance = matrix_from(message.covariance);
  match.inlier_share = message.inlier_share;
  match.contradiction_share = message.contradiction_share;
  match.rms_residual_m = message.rms_residual_m;
  match.degenerate = degenerate_directions(message);
  match.lever_arm_m = message.lever_arm_m;
  match.wheels_scale_sd = message.wheels_scale_sd;
  match.iterations = message.iterations;
  match.searched = message.searched != 0;
  match.points = message.points;
  return match;
}

match_doubt_t to_message(const MatchDoubt& doubt) {
  match_doubt_t message;
  message.utime = doubt.utime;
  message.from_utime = doubt.from_utime;
  message.reason = static_cast<std::int8_t>(doubt.reason);
  message.n_alternatives = static_cast<std::int32_t>(doubt.alternatives.size());
  for (const MatchDoubt::Alternative& alternative : doubt.alternatives) {
    const Pose2& T = alternative.T_odom_body;
    message.T_odom_alternative.push_back({T.x, T.y, T.theta});
    message.scores.push_back(alternative.score);
  }
  return message;
}

Result<MatchDoubt> from_message(const match_doubt_t& message) {
  using Reason = MatchDoubt::Reason;
  if (const auto reason = implausible_field(message); !reason.empty()) return Rejected{reason};
  if (message.from_utime > message.utime) return Rejected{"ends before it begins"};
  MatchDoubt doubt{message.utime, message.from_utime, Reason(message.reason), {}};
  for (std::size_t i = 0; i < message.scores.size(); ++i) {
    const Eigen::Vector3d T(message.T_odom_alternative[i].data());
    doubt.alternatives.push_back({Pose2::from_vector(T), message.scores[i]});
  }
  return doubt;
}

}  // namespace adit
