// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "common/geometry/pose2.hpp"
#include "common/sensing/wheel_odometry.hpp"

namespace adit {

/// Readings in order of time.
using WheelTrack = std::deque<WheelOdometry>;

/// T_wheel_body at `utime`: between readings by interpolation, after the last one at its speed;
/// nothing before the first and where the last is older than `gap_max_s`.
std::optional<Pose2> wheel_pose_at(const WheelTrack& wheels, std::int64_t utime, double gap_max_s);

/// Have the wheels not moved from `since` until the last reading? Since before the last pose, for
/// odometry that repeats itself for a moment is not enough. No where there is no reading so old.
bool wheels_stand(const WheelTrack& wheels, std::int64_t since);

}  // namespace adit
