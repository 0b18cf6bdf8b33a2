// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <random>
#include <span>
#include <vector>

#include "drivers/device/device_protocol.hpp"

#include "common/sensing/laser_scan.hpp"

namespace adit {

/// A driver and an emulated device on one line, in simulated time: bytes arrive at the driver when
/// it is scheduled, some of them damaged, none while the cable is pulled.
template <class Emulator, class Reading = LaserScan>
class LaserLine {
 public:
  struct Faults {
    double corrupt_share = 0.0;    ///< of the bytes to the driver
    double to_device_share = 0.0;  ///< of the bytes to the device, corrupt as well
    double late_share = 0.0;       ///< of the turns of the driver: it is scheduled late,
    std::int64_t late_us = 0;      ///< by this time
    bool is_pulled = false;
  };

  /// `tick_us`: period of the timeouts of the driver.
  LaserLine(ReadingDevice<Reading>& device, Emulator& laser, std::int64_t tick_us = kTurnUs)
      : device_(device), laser_(laser), tick_us_(tick_us) {}

  Faults faults;

  void start(std::int64_t utime) {
    now_ = utime;
    laser_.advance(now_, baud_);  // what it sent before is lost
    device_.start(now_);
    obey();
  }

  /// Runs until this time; `on_reading` gets each reading and the time at which the driver had it.
  void run_until(std::int64_t utime,
                 const std::function<void(const Reading&, std::int64_t)>& on_reading) {
    while (now_ < utime) {
      now_ += kTurnUs;
      if (std::uniform_real_distribution<>()(random_) < faults.late_share) now_ += faults.late_us;
      std::vector<std::uint8_t> bytes;
      for (const auto& timed : laser_.advance(now_, baud_))
        bytes.push_back(damaged(timed.byte, faults.corrupt_share));
      if (faults.is_pulled) bytes.clear();
      if (!bytes.empty()) {
        for (const Reading& reading : device_.receive(bytes, now_)) on_reading(reading, now_);
      }
      if (now_ >= next_tick_us_) {
        device_.tick(now_);
        next_tick_us_ = now_ + tick_us_;
      }
      obey();
    }
  }

  [[nodiscard]] std::int64_t now() const { return now_; }

 private:
  static constexpr std::int64_t kTurnUs = 500;

  std::uint8_t damaged(std::uint8_t byte, double share) {
    if (std::uniform_real_distribution<>()(random_) >= share) return byte;
    return static_cast<std::uint8_t>(random_());
  }

  void obey() {
    for (const PortRequest& request : device_.take_requests()) {
      if (request.baud) baud_ = *request.baud;
      if (faults.is_pulled) continue;
      std::vector<std::uint8_t> bytes = request.bytes;
      if (faults.to_device_share > 0.0) {
        for (std::uint8_t& byte : bytes) byte = damaged(byte, faults.to_device_share);
      }
      laser_.receive(bytes, baud_, now_);
    }
  }

  ReadingDevice<Reading>& device_;
  Emulator& laser_;
  std::int64_t tick_us_;
  std::mt19937 random_{3};
  std::int64_t now_ = 0;
  std::int64_t next_tick_us_ = 0;
  int baud_ = 0;
};

}  // namespace adit
