// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "common/messages/lidar.hpp"
#include "common/messages/result.hpp"
#include "common/sensing/laser_scan.hpp"

namespace adit {

/// A message of a driver.
struct ChannelReading {
  std::int64_t utime = 0;      ///< stamp [µs since the epoch]
  std::vector<double> values;  ///< what it measures, in the order of the message
  std::optional<LaserScan> scan;
  std::optional<double> yaw_rate_rad_s;  ///< of an IMU
  std::optional<LidarFragment> lidar;
};

/// A channel that drivers publish.
struct DriverChannel {
  std::string_view name;
  double rate_min_hz;     ///< below, the stages do not work well
  double age_min_ms;      ///< a stamp of the time of measurement is older when it arrives
  double interval_max_s;  ///< between two messages, after which the guard stops the vehicle
  double jitter_max_ms;   ///< of the stamps; more if the device is asked for each reading
  Result<ChannelReading> (*read)(std::span<const std::uint8_t> bytes);
};

/// All channels that drivers publish and `adit check-driver` knows.
std::span<const DriverChannel> driver_channels();

}  // namespace adit
