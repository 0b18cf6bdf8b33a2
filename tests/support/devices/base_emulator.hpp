// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <random>
#include <span>
#include <vector>

#include "tests/support/lasers/timed_byte.hpp"

namespace adit {

/// A base as drivers/base_serial/README.md describes it, written from that and not from our driver.
/// It knows no real time: the caller says when bytes arrive and until when it wants those that
/// leave.
class BaseEmulator {
 public:
  struct Params {
    int baud = 115200;
    double boot_s = 0.3;
    double clock_rate = 1.0;           ///< of its clock, by the true time
    std::uint32_t clock_start_us = 0;  ///< at power on
    std::int32_t ticks_start = 0;
    std::uint8_t version = 1;
    std::uint16_t battery_mv = 24000;
    /// Ticks of both sides, if something else moves the wheels and not this emulator.
    std::function<std::array<double, 2>(std::int64_t utime)> moved_ticks = {};
  };

  explicit BaseEmulator(Params params) : params_(params) {}

  void power_on(std::int64_t utime);
  void power_off();
  /// It is on since earlier and known to a computer.
  void already_streams(std::int64_t utime);

  void receive(std::span<const std::uint8_t> bytes, int host_baud, std::int64_t utime);
  std::vector<TimedByte> advance(std::int64_t utime, int host_baud);

  bool emergency_switch = false;
  bool motor_fault = false;

  /// True ticks of both sides since power on at a time up to now.
  [[nodiscard]] std::array<double, 2> ticks_at(std::int64_t utime) const;
  [[nodiscard]] std::array<double, 2> speeds_ticks_s() const { return speeds_; }
  [[nodiscard]] std::array<std::int32_t, 2> targets_ticks_s() const { return targets_; }
  [[nodiscard]] bool is_expired() const { return is_expired_; }
  [[nodiscard]] bool brakes() const { return brakes_; }
  [[nodiscard]] int drives() const { return drives_; }  ///< valid ones

 private:
  void step(std::int64_t utime);
  void move();
  void read_input(std::int64_t utime);
  void execute(std::span<const std::uint8_t> frame, std::int64_t utime);
  void send_state(std::int64_t utime);
  void send(std::uint8_t type, std::vector<std::uint8_t> payload, std::int64_t utime);
  [[nodiscard]] std::uint32_t clock_at(std::int64_t utime) const;

  Params params_;
  std::mt19937 random_{29};
  bool is_on_ = false;
  bool is_new_ = true;
  bool is_expired_ = true;
  bool brakes_ = false;
  std::int64_t power_on_us_ = 0;
  std::int64_t booted_us_ = 0;
  std::int64_t now_us_ = 0;
  std::int64_t next_state_us_ = 0;
  std::int64_t last_drive_us_ = 0;
  std::array<std::int32_t, 2> targets_{};
  double acceleration_ = 1000.0;
  double braking_ = 5000.0;
  std::array<double, 2> speeds_{};
  std::array<double, 2> ticks_{};
  std::deque<std::array<double, 3>> history_;  // time, left, right of each millisecond
  std::uint8_t sequence_ = 0;
  std::uint8_t drive_sequence_ = 0;
  std::uint16_t damaged_ = 0;
  int drives_ = 0;
  std::vector<std::uint8_t> input_;
  std::deque<TimedByte> line_;
  std::int64_t line_free_us_ = 0;
};

}  // namespace adit
