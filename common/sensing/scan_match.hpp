// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"

namespace adit {

/// A direction of motion in which a scan says nothing, and what stood in for the scan there.
struct DegenerateDirection {
  enum class Fill : std::int8_t { kNone = 0, kOdometry = 1, kImu = 2 };

  /// Unit vector of (x [m], y [m], θ [rad] · ScanMatch::lever_arm_m), in the body frame.
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  Fill fill = Fill::kNone;

  friend bool operator==(const DegenerateDirection&, const DegenerateDirection&) = default;
};

/// What scan matching made of one scan.
struct ScanMatch {
  enum class Status : std::int8_t {
    kFirstScan = 0,  ///< nothing of this laser to match against: the pose is the prediction
    kMatched = 1,
    kLost = 2,      ///< no match to be trusted: the pose is the prediction
    kRejected = 3,  ///< time did not advance: the pose is the last one and nothing was changed
  };

  std::int64_t utime = 0;             ///< of the scan [µs since the epoch]
  std::int64_t reference_utime = 0;   ///< of the scan before it, 0 for the first
  std::int64_t odom_epoch_utime = 0;  ///< of the first scan in this odom frame
  std::string channel;                ///< on which the scan came
  Status status = Status::kRejected;
  Pose2 T_odom_body;
  Pose2 T_reference_body;  ///< motion since `reference_utime`

  /// Of T_reference_body: of (x, y, θ) in the body frame at `utime` [m, m, rad].
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double inlier_share = 0.0;         ///< of the points that agree with the reference, 0 to 1
  double contradiction_share = 0.0;  ///< of the points in space that was seen free, 0 to 1
  double rms_residual_m = 0.0;       ///< of the inliers
  std::vector<DegenerateDirection> degenerate;
  double lever_arm_m = 1.0;  ///< that turns an angle into a length in `degenerate`
  std::int32_t iterations = 0;
  bool searched = false;  ///< whether the correlative search was asked
  std::int32_t points = 0;

  friend bool operator==(const ScanMatch&, const ScanMatch&) = default;
};

/// Whether there is a direction in which neither the scan nor a sensor tells the motion.
inline bool has_unobserved_direction(const ScanMatch& match) {
  return std::any_of(match.degenerate.begin(), match.degenerate.end(), [](const auto& direction) {
    return direction.fill == DegenerateDirection::Fill::kNone;
  });
}

}  // namespace adit
