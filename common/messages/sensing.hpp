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

/// The channel of a laser, which also identifies the laser in messages.
inline std::string_view laser_channel(LaserId laser) {
  return laser == LaserId::kFront ? "LASER_FRONT" : "LASER_REAR";
}

/// Nothing if the channel is not that of a laser.
inline std::optional<LaserId> laser_from_channel(std::string_view channel) {
  if (channel == laser_channel(LaserId::kFront)) return LaserId::kFront;
  if (channel == laser_channel(LaserId::kRear)) return LaserId::kRear;
  return std::nullopt;
}

constexpr const char* kUnknownLaser = "unknown laser";

/// Bearings are encoded as floats and restored within 2e-7 rad.
planar_lidar_t to_message(const LaserScan& scan);

/// Why the beams of a scan are invalid, or nothing.
std::string_view rejection_reason(const LaserScan& scan);

/// Rejects an implausible time and bearings that are not finite, do not increase, or span more than
/// two turns. Ranges are not checked. Intensities are dropped.
Result<LaserScan> from_message(const planar_lidar_t& message);

/// Without orientation, which ImuReading does not have.
imu_t to_message(const ImuReading& reading);

/// Rejects an implausible time, rates or accelerations that are not finite.
Result<ImuReading> from_message(const imu_t& message);

/// The rates, which WheelOdometry does not have, are NaN in the message.
wheel_odometry_t to_message(const WheelOdometry& odometry);

/// Rejects an implausible time and a pose that is not finite. The rates are ignored.
Result<WheelOdometry> from_message(const wheel_odometry_t& message);

tilt_t to_message(const TiltReading& reading);

/// Rejects an implausible time, an angle or rate that is not finite.
Result<TiltReading> from_message(const tilt_t& message);

tilt_command_t to_message(const TiltCommand& command);

/// Rejects an implausible time, an angle or rate that is not finite, a rate that is not positive.
Result<TiltCommand> from_message(const tilt_command_t& message);

scan_request_t to_message(const ScanRequest& request);

/// Rejects an implausible time, a negative id, a laser other than LASER_FRONT and LASER_REAR.
Result<ScanRequest> from_message(const scan_request_t& message);

gas_t to_message(const GasReading& reading);

/// Rejects an implausible time, a share outside 0 to 1.
Result<GasReading> from_message(const gas_t& message);

sinkage_t to_message(const SinkageReading& reading);

/// Rejects an implausible time, a depth that is negative or not finite.
Result<SinkageReading> from_message(const sinkage_t& message);

}  // namespace adit
