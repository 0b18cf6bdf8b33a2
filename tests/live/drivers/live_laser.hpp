// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>

#include "common/bus/channels.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/sensing.hpp"
#include "tests/live/drivers/live_driver.hpp"

namespace adit {

/// The process of the driver of an emulated laser.
template <class Emulator, class Line>
class LiveLaser : public LiveDriver<Line> {
 public:
  /// Distance in units of a beam of a scan.
  using Reading = std::function<std::uint32_t(int scan, int beam)>;

  LiveLaser(Emulator& laser, Line& line, Reading reading, double unit_m)
      : LiveDriver<Line>(line), laser_(laser), reading_(std::move(reading)), unit_m_(unit_m) {
    subscribe<planar_lidar_t>(this->bus(), channels::kLaserFront, Delivery::queued(1000),
                              [this](const LaserScan& scan) { check(scan); });
  }

 private:
  void check(const LaserScan& scan) {
    ++this->readings;
    const auto raw_of = [&](std::size_t beam) {
      return static_cast<std::uint32_t>(std::lround(scan.ranges_m[beam] / unit_m_));
    };
    int number = laser_.scans_sent() - 1;
    while (number > 0 && reading_(number, 0) != raw_of(0)) --number;
    bool right = number >= 0;
    for (std::size_t beam = 0; right && beam < scan.ranges_m.size(); ++beam) {
      right = raw_of(beam) == reading_(number, static_cast<int>(beam));
    }
    this->wrong += right ? 0 : 1;
    if (right)
      this->add_stamp_error(1e-3 * static_cast<double>(scan.utime - laser_.scan_start(number)));
  }

  Emulator& laser_;
  Reading reading_;
  double unit_m_;
};

}  // namespace adit
