// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/scan_match.hpp"

#include <algorithm>
#include <optional>

#include "common/messages/planar.hpp"

namespace adit {
namespace {

using Status = ScanMatch::Status;
using Fill = DegenerateDirection::Fill;

static_assert(static_cast<int>(Status::kFirstScan) == scan_match_t::STATUS_FIRST_SCAN);
static_assert(static_cast<int>(Status::kMatched) == scan_match_t::STATUS_MATCHED);
static_assert(static_cast<int>(Status::kLost) == scan_match_t::STATUS_LOST);
static_assert(static_cast<int>(Status::kRefused) == scan_match_t::STATUS_REFUSED);
static_assert(static_cast<int>(Fill::kNone) == scan_match_t::FILL_NONE);
static_assert(static_cast<int>(Fill::kOdometry) == scan_match_t::FILL_ODOMETRY);
static_assert(static_cast<int>(Fill::kImu) == scan_match_t::FILL_IMU);

bool is_known(ScanMatch::Status status) {
  return status >= ScanMatch::Status::kFirstScan && status <= ScanMatch::Status::kRefused;
}

bool is_known(DegenerateDirection::Fill fill) {
  return fill >= DegenerateDirection::Fill::kNone && fill <= DegenerateDirection::Fill::kImu;
}

std::vector<DegenerateDirection> degenerate_directions(const scan_match_t& message) {
  std::vector<DegenerateDirection> directions;
  for (std::size_t i = 0; i < message.degenerate_directions.size(); ++i) {
    directions.push_back({Eigen::Vector3d(message.degenerate_directions[i].data()),
                          DegenerateDirection::Fill(message.degenerate_fills[i])});
  }
  return directions;
}

std::string_view reason_to_refuse(const scan_match_t& message) {
  const bool finite = all_finite(message.T_odom_body) && all_finite(message.delta) &&
                      matrix_from(message.covariance).allFinite();
  if (!is_plausible_utime(message.utime)) return kImplausibleTime;
  if (!is_plausible_utime(message.reference_utime)) return kImplausibleTime;
  if (!is_plausible_utime(message.odom_utime)) return kImplausibleTime;
  if (!is_known(ScanMatch::Status(message.status))) return "unknown status";
  if (!finite) return "pose or covariance is not finite";
  if (message.n_degenerate > 3) return "more than three degenerate directions";
  return {};
}

}  // namespace

scan_match_t to_message(const ScanMatch& match) {
  scan_match_t message;
  message.utime = match.utime;
  message.reference_utime = match.reference_utime;
  message.odom_utime = match.odom_utime;
  message.channel = match.channel;
  message.status = static_cast<std::int8_t>(match.status);
  set_pose(match.T_odom_body, message.T_odom_body);
  set_pose(match.T_reference_body, message.delta);
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
  message.iterations = match.iterations;
  message.searched = static_cast<std::int8_t>(match.searched);
  message.points = match.points;
  return message;
}

Result<ScanMatch> from_message(const scan_match_t& message) {
  if (const auto reason = reason_to_refuse(message); !reason.empty()) return Refused{reason};
  ScanMatch match;
  match.utime = message.utime;
  match.reference_utime = message.reference_utime;
  match.odom_utime = message.odom_utime;
  match.channel = message.channel;
  match.status = ScanMatch::Status(message.status);
  match.T_odom_body = pose_from(message.T_odom_body);
  match.T_reference_body = pose_from(message.delta);
  match.covariance = matrix_from(message.covariance);
  match.inlier_share = message.inlier_share;
  match.contradiction_share = message.contradiction_share;
  match.rms_residual_m = message.rms_residual_m;
  match.degenerate = degenerate_directions(message);
  for (const DegenerateDirection& degenerate : match.degenerate) {
    if (!degenerate.direction.allFinite()) return Refused{"degenerate direction is not finite"};
    if (!is_known(degenerate.fill)) return Refused{"unknown fill"};
  }
  match.lever_arm_m = message.lever_arm_m;
  match.iterations = message.iterations;
  match.searched = message.searched != 0;
  match.points = message.points;
  return match;
}

}  // namespace adit
