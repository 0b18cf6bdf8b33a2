// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "common/geometry/pose2.hpp"
#include "common/sensing/vehicle_readings.hpp"
#include "common/sensing/wheel_readings.hpp"

namespace adit {

/// Splits wheel odometry into the steps between scans. The steps add up to the motion of the
/// wheels: what is extrapolated to a scan that is newer than the last reading is not counted again.
class WheelSteps {
 public:
  /// A reading that does not advance in time is ignored.
  void add(const WheelOdometry& reading);

  /// The motion of the body by the wheels since the last call. Empty if the readings have a gap
  /// there, or a step that no vehicle drives: a reset of the odometry.
  std::optional<Pose2> step_to(std::int64_t utime);

  /// Removes all readings: those to come have other times.
  void clear() { *this = {}; }

 private:
  WheelReadings readings_;
  std::int64_t utime_ = 0;             ///< of the last call
  std::optional<Pose2> T_wheel_body_;  ///< then
};

}  // namespace adit
