// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

namespace adit {

/// Deviation of the steered point of the body from a path. The steered point is the origin with
/// four-wheel steering and the middle of the rear axle with Ackermann steering.
struct PathTrackingError {
  double lateral_m = 0.0;    ///< positive to the left of the body's heading on the path
  double heading_rad = 0.0;  ///< of the body's x axis relative to the path

  friend bool operator==(const PathTrackingError&, const PathTrackingError&) = default;
};

/// Progress along a path.
struct DrivingState {
  enum class Kind : std::int8_t {
    kIdle = 0,     ///< no path
    kDriving = 1,  ///< following the path
    kWaiting = 2,  ///< stopped until the pose is valid or motion is permitted
    kArrived = 3,  ///< stopped at the end of the path
    kFailed = 4,   ///< stopped off the path or blocked; needs a new path
  };

  std::int64_t utime = 0;    ///< [µs since the epoch]
  std::int32_t path_id = 0;  ///< id of the goal that the path answers; 0 before the first path
  Kind kind = Kind::kIdle;
  std::string reason;  ///< for the operator, unless driving or arrived
  double progress_m = 0.0;
  double remaining_m = 0.0;
  PathTrackingError error;

  friend bool operator==(const DrivingState&, const DrivingState&) = default;
};

/// "idle", "driving", ..
constexpr const char* name_of(DrivingState::Kind kind) {
  switch (kind) {
    case DrivingState::Kind::kIdle:
      return "idle";
    case DrivingState::Kind::kDriving:
      return "driving";
    case DrivingState::Kind::kWaiting:
      return "waiting";
    case DrivingState::Kind::kArrived:
      return "arrived";
    case DrivingState::Kind::kFailed:
      return "failed";
  }
  return "";
}

}  // namespace adit
