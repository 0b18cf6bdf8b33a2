// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "common/geometry/pose2.hpp"

namespace adit {

/// Pose of the body by dead reckoning of the wheels, in a frame of its own that starts anywhere.
/// Only the motion between two readings means anything.
struct WheelOdometry {
  std::int64_t utime = 0;  ///< time of measurement [µs since the epoch]
  Pose2 T_wheel_body;
};

}  // namespace adit
