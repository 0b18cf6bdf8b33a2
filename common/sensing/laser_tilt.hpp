// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>

#include "common/sensing/laser_scan.hpp"

namespace adit {

/// Tilt of a laser relative to its level mount; positive tilts it downwards.
struct TiltReading {
  std::int64_t utime = 0;  ///< time of measurement [µs since the epoch]
  double angle_rad = 0.0;
  double rate_rad_s = 0.0;

  friend bool operator==(const TiltReading&, const TiltReading&) = default;
};

/// When a laser is level enough for its scans to be scans of a plane. A rate that is not a number
/// is unknown, and does not count.
struct LevelTilt {
  double angle_max_rad = 0.0;
  double rate_max_rad_s = 0.0;

  [[nodiscard]] bool is_level(const TiltReading& tilt) const {
    return std::abs(tilt.angle_rad) <= angle_max_rad &&
           !(std::abs(tilt.rate_rad_s) > rate_max_rad_s);
  }
};

/// Target angle of a tilting laser, and the rate at which to reach it. The laser holds the target.
struct TiltCommand {
  std::int64_t utime = 0;   ///< time of the command [µs since the epoch]
  double angle_rad = 0.0;   ///< as in TiltReading: positive tilts the laser downwards
  double rate_rad_s = 0.0;  ///< maximum rate, positive

  friend bool operator==(const TiltCommand&, const TiltCommand&) = default;
};

/// Requests a 3D scan from a standing robot: one tilt sweep of a laser.
struct ScanRequest {
  std::int64_t utime = 0;  ///< time of the request [µs since the epoch]
  std::int32_t id = 0;     ///< id of the resulting cloud
  LaserId laser = LaserId::kFront;

  friend bool operator==(const ScanRequest&, const ScanRequest&) = default;
};

}  // namespace adit
