// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"
#include "common/sensing/laser_scan.hpp"

namespace adit {

/// A scan of a local map.
struct LocalScan {
  std::string channel;  ///< on which the scan came, e.g. LASER_FRONT
  LaserScan scan;
  Pose2 T_local_body;

  friend bool operator==(const LocalScan&, const LocalScan&) = default;
};

/// A few metres of the way, rigid in itself: the scans of it, each with its pose in the frame of
/// the local map. That frame is the body at the first scan, which is in turn the last scan of the
/// local map before, so that consecutive local maps touch.
struct LocalMap {
  int id = 0;                  ///< 0, 1, … in the order of the way, over all sessions
  int session = 0;             ///< counts the times that the mapping began with a new odom frame
  std::int64_t utime = 0;      ///< of the first scan [µs since the epoch]
  std::int64_t end_utime = 0;  ///< of the last
  Pose2 T_odom_local;          ///< pose of this local map in odom
  /// Displacement from the local map `id` − 1, and its information (x, y, θ in this frame). Without
  /// meaning for the first of a session.
  Pose2 T_previous_local;
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  std::vector<LocalScan> scans;

  friend bool operator==(const LocalMap&, const LocalMap&) = default;
};

}  // namespace adit
