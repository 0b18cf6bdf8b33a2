// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/geometry/attitude.hpp"
#include "common/geometry/pose2.hpp"

namespace adit {

/// A direction of motion that the scan does not constrain, and what replaced the scan there.
struct DegenerateDirection {
  enum class Fill : std::int8_t { kNone = 0, kOdometry = 1, kImu = 2 };

  /// Unit vector of (x [m], y [m], θ [rad] · ScanMatch::lever_arm_m), in the body frame.
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  Fill fill = Fill::kNone;

  friend bool operator==(const DegenerateDirection&, const DegenerateDirection&) = default;
};

/// The result of scan matching for one scan.
struct ScanMatch {
  enum class Status : std::int8_t {
    kFirstScan = 0,  ///< no reference of this laser yet: the pose is the prediction
    kMatched = 1,
    kLost = 2,      ///< no accepted match: the pose is the prediction
    kRejected = 3,  ///< time did not advance: the pose is the last one and no state changed
  };

  std::int64_t utime = 0;             ///< of the scan [µs since the epoch]
  std::int64_t reference_utime = 0;   ///< of the previous scan, 0 for the first
  std::int64_t odom_epoch_utime = 0;  ///< of the first scan in the odom frame
  std::string channel;                ///< channel of the scan
  Status status = Status::kRejected;
  Pose2 T_odom_body;
  Pose2 T_reference_body;  ///< motion since `reference_utime`

  /// Against gravity: by the IMU, without one by the ground that 3D scans showed; nothing if
  /// unknown.
  std::optional<Attitude> attitude;
  bool attitude_from_ground = false;
  double z_m = 0.0;  ///< height of the body in odom, by its motion along its pitch
  /// Beams of the scan that hit the ground or the roof, not a wall, in increasing order.
  std::vector<std::int32_t> ground_beams;
  /// Beams that hit what may be ground or roof, though no 3D scan shows whether, in increasing
  /// order. Without 3D scans, whether any are taken for walls is up to who reads them.
  std::vector<std::int32_t> unconfirmed_beams;

  /// Covariance of T_reference_body: of (x, y, θ) in the body frame at `utime` [m, m, rad].
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double inlier_share = 0.0;         ///< share of points that agree with the reference, 0 to 1
  double contradiction_share = 0.0;  ///< share of points in observed free space, 0 to 1
  double rms_residual_m = 0.0;       ///< of the inliers
  std::vector<DegenerateDirection> degenerate;
  double lever_arm_m = 1.0;  ///< converts an angle to a length in `degenerate`
  /// Standard deviation of the scale of the wheels, where they replace the scan; 0 without wheels.
  double wheels_scale_sd = 0.0;
  std::int32_t iterations = 0;
  bool searched = false;  ///< whether the correlative search ran
  std::int32_t points = 0;

  friend bool operator==(const ScanMatch&, const ScanMatch&) = default;
};

/// Whether neither the scan nor a sensor observed the motion in some direction.
inline bool has_unobserved_direction(const ScanMatch& match) {
  return std::any_of(match.degenerate.begin(), match.degenerate.end(), [](const auto& direction) {
    return direction.fill == DegenerateDirection::Fill::kNone;
  });
}

}  // namespace adit
