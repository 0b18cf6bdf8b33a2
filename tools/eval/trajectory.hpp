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

/// Sum of the distances from pose to pose [m]. What jitters is longer by that.
double path_length_m(const Trajectory& trajectory);

/// Length of the way of a robot whose poses jitter [m]: motion counts as soon as it has led at
/// least `step_m` away from the last pose that counted. What jitters by less has no length; of a
/// straight way less than a step is missing at the end, and of an arc of radius R in steps of s the
/// share s²/24R².
double distance_travelled_m(const Trajectory& trajectory, double step_m);

/// A step for distance_travelled_m: longer than matched scans jitter, much shorter than a bend.
inline constexpr double kTravelStepM = 0.2;

}  // namespace adit
