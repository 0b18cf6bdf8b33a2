// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "tests/support/lasers/timed_byte.hpp"

namespace adit {

/// A Hokuyo laser as the specification of SCIP 2.0 describes it, written from that and not from our
/// driver. It knows no real time: the caller says when bytes arrive and until when it wants those
/// that leave.
class ScipEmulator {
 public:
  struct Params {
    bool has_baud = true;  ///< a serial line; otherwise USB or TCP, 10 Mbit/s
    int baud_after_power_on = 19200;
    double boot_s = 1.0;
    double clock_rate = 1.0;  ///< of its time and its mirror, by the true time
    std::uint32_t clock_start_ms = 0;
    bool tells_time = true;  ///< knows TM
    // A UTM-30LX.
    int steps_per_turn = 1440;
    int first_step = 0;
    int last_step = 1080;
    int front_step = 540;
    int scans_per_minute = 2400;
    int range_min_mm = 23;
    int range_max_mm = 60000;
  };

  /// Time of the first scan behind power on [µs].
  static constexpr std::int64_t kFirstScanUs = 1234;

  /// Distance of a step [mm], or a code. `scan`: number of the scan.
  using Reading = std::function<std::uint32_t(int scan, int step)>;

  ScipEmulator(Params params, Reading reading);

  void power_on(std::int64_t utime);
  void power_off();
  /// It measures and sends since earlier, all steps with three characters each.
  void already_streams(std::int64_t utime, int baud);

  void receive(std::span<const std::uint8_t> bytes, int host_baud, std::int64_t utime);
  std::vector<TimedByte> advance(std::int64_t utime, int host_baud);

  /// Time of the first step of each scan that was sent, by its number [µs].
  [[nodiscard]] std::int64_t scan_start(int scan) const;
  [[nodiscard]] int scans_sent() const { return static_cast<int>(starts_.size()); }
  [[nodiscard]] int baud() const { return baud_; }

 private:
  struct Pending {
    std::int64_t start = 0;
    std::string text;
    int baud_after = 0;
  };

  void execute(const std::string& line, std::int64_t utime);
  std::string execute_measurement(const std::string& line);
  void measure(std::int64_t until);
  void send(std::string text, std::int64_t start, int baud_after = 0);
  [[nodiscard]] std::string parameters() const;
  [[nodiscard]] std::string time_at(std::int64_t utime) const;
  [[nodiscard]] double byte_us() const;

  Params params_;
  Reading reading_;
  std::mt19937 random_{17};
  bool is_on_ = false;
  bool laser_is_on_ = false;
  bool is_adjusting_ = false;
  std::string continuous_;  ///< the command of the output; empty without
  int from_ = 0;
  int to_ = 0;
  int characters_ = 3;
  std::int64_t power_on_us_ = 0;
  std::int64_t booted_us_ = 0;
  int baud_ = 0;
  std::string input_;
  std::deque<Pending> pending_;
  std::deque<TimedByte> line_;
  std::int64_t line_free_us_ = 0;
  std::int64_t next_scan_ = 0;
  std::vector<std::int64_t> starts_;
};

}  // namespace adit
