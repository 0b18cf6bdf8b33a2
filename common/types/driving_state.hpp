// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

namespace adit {

/// Where the steered point of the body is beside a path: the origin with four-wheel steering, the
/// middle of the rear axle with Ackermann steering.
struct PathTrackingError {
  double lateral_m = 0.0;    ///< to the left of the path, as the body on it looks
  double heading_rad = 0.0;  ///< of the body's x axis against that of the body on the path

  friend bool operator==(const PathTrackingError&, const PathTrackingError&) = default;
};

/// How driving along a path stands.
struct DrivingState {
  enum class Kind : std::int8_t {
    kIdle = 0,     ///< there is no path to drive
    kDriving = 1,  ///< on its way
    kWaiting = 2,  ///< stands until it knows again where it is, or is let go
    kArrived = 3,  ///< stands at the end of the path
    kFailed = 4,   ///< stands beside the path, or cannot go on, and needs a new one
  };

  std::int64_t utime = 0;    ///< [µs since the epoch]
  std::int32_t path_id = 0;  ///< of the goal that the path answers; 0 before the first path
  Kind kind = Kind::kIdle;
  std::string reason;  ///< for people, where it neither drives nor has arrived
  double progress_m = 0.0;
  double remaining_m = 0.0;
  PathTrackingError error;

  friend bool operator==(const DrivingState&, const DrivingState&) = default;
};

}  // namespace adit
