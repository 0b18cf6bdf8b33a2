// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "common/cloud/cloud.hpp"
#include "common/sensing/laser_mount.hpp"
#include "common/sensing/laser_scan.hpp"
#include "common/sensing/scan_timing.hpp"
#include "procs/scan_assembly/time_track.hpp"

namespace adit {

/// Places beams in level, each from where the laser was at its own time.
class BeamPlacing {
 public:
  /// Both tracks must have something in them, and outlive this. Where the body was, as it stands:
  /// `R_level_body` makes it level wherever it goes.
  struct Motion {
    const TimeTrack<double>& tilt_rad;
    const TimeTrack<Pose2>& T_odom_body;
    Pose2 T_odom_level;
    Eigen::Matrix3d R_level_body;
  };

  BeamPlacing(const LaserMount& mount, const ScanTiming& timing, const Motion& motion)
      : mount_(mount), timing_(timing), motion_(motion) {}

  /// `ranges_m` are those of the scan as RangeImage has them.
  [[nodiscard]] CloudLine place(const LaserScan& scan, const std::vector<float>& ranges_m) const;

  /// [µs since the epoch], of beams 0 to n − 1 of the scan.
  [[nodiscard]] std::int64_t utime_of_beam(const LaserScan& scan, int beam) const;
  /// When the last of its beams is measured.
  [[nodiscard]] std::int64_t end_utime(const LaserScan& scan) const;

 private:
  [[nodiscard]] Eigen::Isometry3d T_level_laser(std::int64_t utime) const;

  const LaserMount& mount_;
  const ScanTiming& timing_;
  Motion motion_;
};

}  // namespace adit
