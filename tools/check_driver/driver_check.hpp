// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tools/check_driver/channel_reading.hpp"
#include "tools/check_driver/check_result.hpp"
#include "tools/check_driver/lidar_checks.hpp"
#include "tools/check_driver/scan_checks.hpp"
#include "tools/check_driver/time_checks.hpp"

namespace adit {

/// Says whether the messages on a channel are what the stages need: collects them and the yaw of
/// other sensors, then checks. Knows neither network nor log.
class DriverCheck {
 public:
  /// `range_max_m`: of this laser by the configuration, if the channel is that of one. Throws
  /// std::invalid_argument, with the names, for a channel that no driver publishes.
  DriverCheck(std::string_view channel, double range_max_m);

  /// Channels to be passed to `add`: the one, and those that tell how the vehicle turns.
  [[nodiscard]] std::vector<std::string_view> channels() const;

  /// A message on any channel. `arrival_utime` [µs since the epoch].
  void add(std::string_view channel, std::span<const std::uint8_t> bytes,
           std::int64_t arrival_utime);

  [[nodiscard]] CheckResults results() const;

 private:
  void add_yaw(std::string_view channel, const ChannelReading& reading);
  [[nodiscard]] CheckResults value_results() const;

  const DriverChannel* channel_;
  double range_max_m_;
  MessageTimes times_;
  std::vector<std::vector<double>> values_;  ///< of other sensors than lasers
  std::vector<LaserScan> scans_;
  LidarReassembler reassembler_;
  std::vector<LidarTurn> turns_;
  std::map<std::string, int, std::less<>> rejections_;
  YawHistory gyro_yaw_;
  YawHistory wheel_yaw_;
};

/// One line each, and a last one: whether all are good.
std::string text_of(std::string_view channel, const CheckResults& results);

bool all_are_good(const CheckResults& results);

}  // namespace adit
