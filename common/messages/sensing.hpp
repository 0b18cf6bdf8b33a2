// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string_view>

#include "adit/gas_t.hpp"
#include "adit/imu_t.hpp"
#include "adit/planar_lidar_t.hpp"
#include "adit/scan_request_t.hpp"
#include "adit/sinkage_t.hpp"
#include "adit/tilt_command_t.hpp"
#include "adit/tilt_t.hpp"
#include "adit/wheel_odometry_t.hpp"

#include "common/messages/result.hpp"
#include "common/sensing/laser_scan.hpp"
#include "common/sensing/laser_tilt.hpp"
#include "common/sensing/vehicle_readings.hpp"

namespace adit {

/// The channel of a laser, which names it in messages.
inline std::string_view laser_channel(LaserId laser) {
  return laser == LaserId::kFront ? "LASER_FRONT" : "LASER_REAR";
}

/// Nothing for a channel that is no laser's.
inline std::optional<LaserId> laser_from_channel(std::string_view channel) {
  if (channel == laser_channel(LaserId::kFront)) return LaserId::kFront;
  if (channel == laser_channel(LaserId::kRear)) return LaserId::kRear;
  return std::nullopt;
}

constexpr const char* kUnknownLaser = "unknown laser";

/// Bearings go onto the wire as floats: they come back within 2e-7 rad.
planar_lidar_t to_message(const LaserScan& scan);

/// Why a scan cannot come from a laser, or nothing; what from_message refuses.
std::string_view rejection_reason(const LaserScan& scan);

/// Refused: an implausible time, bearings that are not finite, that do not increase, or that go
/// round more than twice. Ranges are passed on as they are. Intensities are not kept.
Result<LaserScan> from_message(const planar_lidar_t& message);

/// Without an orientation, which ImuReading does not hold.
imu_t to_message(const ImuReading& reading);

/// Refused: an implausible time, rates or accelerations that are not finite.
Result<ImuReading> from_message(const imu_t& message);

/// The rates, which WheelOdometry does not hold, are NaN on the wire.
wheel_odometry_t to_message(const WheelOdometry& odometry);

/// Refused: an implausible time, a pose that is not finite. The rates are not looked at.
Result<WheelOdometry> from_message(const wheel_odometry_t& message);

tilt_t to_message(const TiltReading& reading);

/// Refused: an implausible time, an angle or rate that is not finite.
Result<TiltReading> from_message(const tilt_t& message);

tilt_command_t to_message(const TiltCommand& command);

/// Refused: an implausible time, an angle or rate that is not finite, a rate that is not positive.
Result<TiltCommand> from_message(const tilt_command_t& message);

scan_request_t to_message(const ScanRequest& request);

/// Refused: an implausible time, a negative id, a laser that is neither LASER_FRONT nor LASER_REAR.
Result<ScanRequest> from_message(const scan_request_t& message);

gas_t to_message(const GasReading& reading);

/// Refused: an implausible time, a share beyond 0 to 1.
Result<GasReading> from_message(const gas_t& message);

sinkage_t to_message(const SinkageReading& reading);

/// Refused: an implausible time, a depth that is negative or not finite.
Result<SinkageReading> from_message(const sinkage_t& message);

}  // namespace adit
