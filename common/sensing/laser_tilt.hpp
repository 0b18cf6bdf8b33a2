// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "common/sensing/laser_scan.hpp"

namespace adit {

/// How far a tilting laser is pitched against its level mount; positive looks down.
struct TiltReading {
  std::int64_t utime = 0;  ///< time of measurement [µs since the epoch]
  double angle_rad = 0.0;
  double rate_rad_s = 0.0;

  friend bool operator==(const TiltReading&, const TiltReading&) = default;
};

/// Where a tilting laser is to go, and how fast. It stays there.
struct TiltCommand {
  std::int64_t utime = 0;   ///< time of the command [µs since the epoch]
  double angle_rad = 0.0;   ///< as in TiltReading: positive looks down
  double rate_rad_s = 0.0;  ///< greatest rate on the way, positive

  friend bool operator==(const TiltCommand&, const TiltCommand&) = default;
};

/// The robot stands and is to look at what is before it: one tilt sweep of a laser.
struct ScanRequest {
  std::int64_t utime = 0;  ///< time of the request [µs since the epoch]
  std::int32_t id = 0;     ///< that the cloud is to have
  LaserId laser = LaserId::kFront;

  friend bool operator==(const ScanRequest&, const ScanRequest&) = default;
};

}  // namespace adit
