// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"

namespace adit {

/// Where a 3D scan was taken: in a local map, at the height of its level frame above the origin of
/// the local map, after a signed distance travelled forwards from there [m].
struct CloudPlace {
  std::int64_t utime = 0;
  int map = 0;
  double z_m = 0.0;
  double forward_m = 0.0;

  friend bool operator==(const CloudPlace&, const CloudPlace&) = default;
};

/// What a match of two 3D scans of a session tells of height and attitude. Their relative pose in
/// plan is a loop closure between the two local maps.
struct CloudMatch {
  CloudPlace older;
  CloudPlace newer;
  Pose2 T_older_newer;    ///< of the loop closure: the newer local map in the older one
  double turn_rad = 0.0;  ///< from the older to the newer scan
  /// Height of the newer scan above the older one [m], as seen in the level frame of the older one:
  /// with the constant error of the attitude, along the lever from the older to the newer scan.
  double rise_m = 0.0;
  double rise_sd_m = 1.0;
  Eigen::Vector2d lever_m = Eigen::Vector2d::Zero();
  /// Rotation vector about x and y of the newer level frame against the older one that remains
  /// without the turn [rad], and its covariance [rad²].
  Eigen::Vector2d tilt_rad = Eigen::Vector2d::Zero();
  Eigen::Matrix2d tilt_covariance = Eigen::Matrix2d::Identity();

  friend bool operator==(const CloudMatch&, const CloudMatch&) = default;
};

}  // namespace adit
