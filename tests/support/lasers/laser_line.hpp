// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <random>
#include <span>
#include <vector>

#include "drivers/laser/laser_device.hpp"

namespace adit {

/// A driver and an emulated laser on one line, in simulated time: bytes arrive at the driver when
/// it is scheduled, some of them damaged, none while the cable is pulled.
template <class Emulator>
class LaserLine {
 public:
  struct Faults {
    double corrupt_share = 0.0;  ///< of the bytes to the driver
    double late_share = 0.0;     ///< of the turns of the driver: it is scheduled late,
    std::int64_t late_us = 0;    ///< by this time
    bool is_pulled = false;
  };

  LaserLine(LaserDevice& device, Emulator& laser) : device_(device), laser_(laser) {}

  Faults faults;

  void start(std::int64_t utime) {
    now_ = utime;
    device_.start(now_);
    obey();
  }

  /// Runs until this time; `on_scan` gets each scan and the time at which the driver had it.
  void run_until(std::int64_t utime,
                 const std::function<void(const LaserScan&, std::int64_t)>& on_scan) {
    while (now_ < utime) {
      now_ += kTurnUs;
      if (std::uniform_real_distribution<>()(random_) < faults.late_share) now_ += faults.late_us;
      std::vector<std::uint8_t> bytes;
      for (const auto& timed : laser_.advance(now_, baud_)) bytes.push_back(damaged(timed.byte));
      if (faults.is_pulled) bytes.clear();
      if (!bytes.empty()) {
        for (const LaserScan& scan : device_.receive(bytes, now_)) on_scan(scan, now_);
      }
      device_.tick(now_);
      obey();
    }
  }

  [[nodiscard]] std::int64_t now() const { return now_; }

 private:
  static constexpr std::int64_t kTurnUs = 500;

  std::uint8_t damaged(std::uint8_t byte) {
    if (std::uniform_real_distribution<>()(random_) >= faults.corrupt_share) return byte;
    return static_cast<std::uint8_t>(random_());
  }

  void obey() {
    for (const PortRequest& request : device_.take_requests()) {
      if (request.baud) baud_ = *request.baud;
      if (!faults.is_pulled) laser_.receive(request.bytes, baud_, now_);
    }
  }

  LaserDevice& device_;
  Emulator& laser_;
  std::mt19937 random_{3};
  std::int64_t now_ = 0;
  int baud_ = 0;
};

}  // namespace adit
