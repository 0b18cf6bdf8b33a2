// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "common/sensing/laser_mount.hpp"
#include "common/sensing/laser_scan.hpp"

namespace adit {

/// A scan without the motion of the body while it was measured ("deskewed").
struct StillScan {
  LaserScan scan;
  /// For each of its beams the measured one that it shows, −1 for none; empty if the scan is the
  /// measured one.
  std::vector<std::int32_t> beam_of;

  /// The measured beam that a beam shows; −1 for none.
  [[nodiscard]] std::int32_t measured_beam(std::int32_t beam) const {
    return beam_of.empty() ? beam : beam_of[static_cast<std::size_t>(beam)];
  }
};

/// The scan that the laser would have measured from where it was at LaserScan::utime, at the same
/// bearings, for a body that moves at a constant `velocity`: of (x, y, θ) in the body frame [m/s,
/// m/s, rad/s]. Between two returns of one surface its ranges are those of the straight line
/// through them, elsewhere that of the nearest beam; NaN where none points within a beam's width.
/// A scan of less than 30 ms, in which a body drives 15 mm at 0.5 m/s, is returned as measured: a
/// SICK LMS-200 takes 7 to 20 ms, a lidar at 20 Hz 50 ms, one at 7 Hz 140 ms.
StillScan without_motion(const LaserScan& scan, const LaserMount& mount,
                         const Eigen::Vector3d& velocity);

}  // namespace adit
