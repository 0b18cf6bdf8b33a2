// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/geometry/attitude.hpp"
#include "common/geometry/pose2.hpp"
#include "common/sensing/laser_scan.hpp"

namespace adit {

/// A scan of a local map.
struct LocalScan {
  std::string channel;  ///< channel of the scan, e.g. LASER_FRONT
  LaserScan scan;       ///< 0 for beams that hit the ground or the roof
  Pose2 T_local_body;
  double z_m = 0.0;  ///< height of the body above that of the first scan
  /// Of the body against gravity, as in ScanMatch.
  std::optional<Attitude> attitude = {};
  std::vector<std::int32_t> unconfirmed_beams = {};  ///< as in ScanMatch
  bool attitude_from_ground = false;                 ///< as in ScanMatch

  friend bool operator==(const LocalScan&, const LocalScan&) = default;
};

/// A rigid map of a few metres of the traversed path: its scans with their poses in the frame of
/// the local map. The frame is the body at the first scan, which is also the last scan of the
/// previous local map, so consecutive local maps share a pose.
struct LocalMap {
  int id = 0;                  ///< 0, 1, … in order of time, over all sessions
  int session = 0;             ///< number of restarts of mapping with a new odom frame
  std::int64_t utime = 0;      ///< time of the first scan [µs since the epoch]
  std::int64_t end_utime = 0;  ///< time of the last scan
  Pose2 T_odom_local;          ///< pose of the local map in odom
  /// Displacement from the local map `id` − 1 with its information (x, y, θ in this frame).
  /// Undefined for the first local map of a session.
  Pose2 T_previous_local;
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  double climb_m = 0.0;    ///< height above the local map `id` − 1; 0 for the first of a session
  double forward_m = 0.0;  ///< distance travelled forwards from there, less that backwards
  double z_odom_m = 0.0;   ///< height of the local map in odom
  std::vector<LocalScan> scans;

  friend bool operator==(const LocalMap&, const LocalMap&) = default;
};

}  // namespace adit
