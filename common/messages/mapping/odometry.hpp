// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include <Eigen/Core>

#include "adit/match_doubt_t.hpp"
#include "adit/pose_t.hpp"
#include "adit/scan_match_t.hpp"

#include "common/geometry/attitude.hpp"
#include "common/geometry/pose2.hpp"
#include "common/messages/result.hpp"
#include "common/sensing/match_doubt.hpp"
#include "common/sensing/scan_match.hpp"

namespace adit {

/// The pose of the body in six degrees of freedom with its time, on channel POSE.
struct StampedPose {
  std::int64_t utime = 0;  ///< time of measurement [µs since the epoch]
  Pose2 T_odom_body;

  /// Velocity in the body frame: forward, left [m/s], yaw rate [rad/s].
  std::optional<Eigen::Vector3d> v_body;

  double z_m = 0.0;        ///< height of the body in odom
  Attitude attitude = {};  ///< against gravity
};

/// Unknown values are NaN in the message: the velocities without `v_body`, the acceleration always.
pose_t to_message(const StampedPose& pose);

/// Rejects an implausible time, a position or orientation that is not finite, an orientation that
/// is not a unit quaternion, or one that points straight up or down and has no heading.
Result<StampedPose> from_message(const pose_t& message);

scan_match_t to_message(const ScanMatch& match);

/// Rejects implausible times, an unknown status or fill, a pose, covariance or direction that is
/// not finite, more than three degenerate directions.
Result<ScanMatch> from_message(const scan_match_t& message);

match_doubt_t to_message(const MatchDoubt& doubt);

/// Rejects implausible times, an end before the beginning, an unknown reason, a pose or score that
/// is not finite.
Result<MatchDoubt> from_message(const match_doubt_t& message);

}  // namespace adit
