// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/geometry/pose2.hpp"

namespace adit {

/// Where the body was at one time, in the frame of its trajectory.
struct TimedPose {
  std::int64_t utime = 0;  ///< [µs since the epoch]
  Pose2 pose;

  friend bool operator==(const TimedPose&, const TimedPose&) = default;
};

/// In order of time; no time comes twice.
using Trajectory = std::vector<TimedPose>;

/// Between two poses, `share` of the way from a to b: position on the straight line, angle the
/// short way round.
Pose2 blend(const Pose2& a, const Pose2& b, double share);

/// The pose at a time between two poses, blended. A stamp written with fewer digits may fall just
/// outside: up to a millisecond beyond an end gives the pose at that end, more than that gives
/// nothing.
std::optional<Pose2> interpolate(const Trajectory& trajectory, std::int64_t utime);

/// Sum of the distances from pose to pose. [m]
double path_length_m(const Trajectory& trajectory);

}  // namespace adit
