// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/scan_match.hpp"

#include <algorithm>
#include <optional>

#include "common/messages/checks.hpp"

namespace adit {
namespace {

using RowMajor3d = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

void set_pose(const Pose2& pose, double (&numbers)[3]) {
  numbers[0] = pose.x;
  numbers[1] = pose.y;
  numbers[2] = pose.theta;
}

bool is_known(ScanMatchReport::Status status) {
  return status >= ScanMatchReport::Status::kFirstScan &&
         status <= ScanMatchReport::Status::kRefused;
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
                      Eigen::Map<const RowMajor3d>(message.covariance[0]).allFinite();
  if (!is_plausible_utime(message.utime)) return kImplausibleTime;
  if (!is_plausible_utime(message.reference_utime)) return kImplausibleTime;
  if (!is_known(ScanMatchReport::Status(message.status))) return "unknown status";
  if (!finite) return "pose or covariance is not finite";
  if (message.n_degenerate > 3) return "more than three degenerate directions";
  return {};
}

}  // namespace

scan_match_t to_message(const ScanMatchReport& report) {
  scan_match_t message;
  message.utime = report.utime;
  message.reference_utime = report.reference_utime;
  message.channel = report.channel;
  message.status = static_cast<std::int8_t>(report.status);
  set_pose(report.T_odom_body, message.T_odom_body);
  set_pose(report.delta, message.delta);
  Eigen::Map<RowMajor3d>(message.covariance[0]) = report.covariance;
  message.inlier_share = report.inlier_share;
  message.rms_residual_m = report.rms_residual_m;
  message.n_degenerate = static_cast<std::int32_t>(report.degenerate.size());
  for (const DegenerateDirection& degenerate : report.degenerate) {
    const Eigen::Vector3d& d = degenerate.direction;
    message.degenerate_directions.push_back({d.x(), d.y(), d.z()});
    message.degenerate_fills.push_back(static_cast<std::int8_t>(degenerate.fill));
  }
  message.iterations = report.iterations;
  message.searched = static_cast<std::int8_t>(report.searched);
  message.points = report.points;
  return message;
}

Result<ScanMatchReport> from_message(const scan_match_t& message) {
  if (const auto reason = reason_to_refuse(message); !reason.empty()) return Refused{reason};
  ScanMatchReport report;
  report.utime = message.utime;
  report.reference_utime = message.reference_utime;
  report.channel = message.channel;
  report.status = ScanMatchReport::Status(message.status);
  report.T_odom_body = {message.T_odom_body[0], message.T_odom_body[1], message.T_odom_body[2]};
  report.delta = {message.delta[0], message.delta[1], message.delta[2]};
  report.covariance = Eigen::Map<const RowMajor3d>(message.covariance[0]);
  report.inlier_share = message.inlier_share;
  report.rms_residual_m = message.rms_residual_m;
  report.degenerate = degenerate_directions(message);
  for (const DegenerateDirection& degenerate : report.degenerate) {
    if (!degenerate.direction.allFinite()) return Refused{"degenerate direction is not finite"};
    if (!is_known(degenerate.fill)) return Refused{"unknown fill"};
  }
  report.iterations = message.iterations;
  report.searched = message.searched != 0;
  report.points = message.points;
  return report;
}

}  // namespace adit
