// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "common/geometry/pose2.hpp"
#include "common/sensing/vehicle_readings.hpp"

namespace adit {

/// Wheel odometry in order of time.
using WheelReadings = std::deque<WheelOdometry>;

/// T_wheel_body at `utime`: interpolated between readings, extrapolated at the last speed after the
/// last one; empty before the first reading and where the last is older than `gap_max_s`.
std::optional<Pose2> wheel_pose_at(const WheelReadings& wheels, std::int64_t utime,
                                   double gap_max_s);

/// Whether the wheels have not moved from `since` until the last reading. False without a reading
/// as old as `since`. The caller chooses `since` before the last pose: odometry that repeats a
/// value for a moment must not count as standstill.
bool wheels_stationary(const WheelReadings& wheels, std::int64_t since);

}  // namespace adit
