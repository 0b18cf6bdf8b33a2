// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <random>
#include <span>
#include <vector>

#include "tests/support/lasers/timed_byte.hpp"

namespace adit {

/// A DYNAMIXEL XL430-W250 as ROBOTIS' e-manual describes it ("DYNAMIXEL Protocol 2.0", control
/// table), written from that and not from our driver. It knows no real time: the caller says when
/// bytes arrive and until when it wants those that leave.
class ServoEmulator {
 public:
  struct Params {
    int baud = 57600;
    std::uint8_t id = 1;
    double boot_s = 0.3;
    double clock_rate = 1.0;           ///< of its realtime tick, by the true time
    std::uint16_t clock_start_ms = 0;  ///< at power on
    std::uint8_t operating_mode = 3;
    std::uint8_t status_return_level = 2;
    std::int32_t position_min = 0;
    std::int32_t position_max = 4095;
    double position = 2048.0;   ///< before power on
    bool line_echoes = false;   ///< what is sent to it comes back
    bool line_has_time = true;  ///< bytes to it take the time of the baud rate
    /// Position, if something else moves it and not this emulator.
    std::function<double(std::int64_t utime)> moved_position = {};
  };

  explicit ServoEmulator(Params params) : params_(params), position_(params.position) {}

  void power_on(std::int64_t utime);
  void power_off();
  /// It is on since earlier and holds this position.
  void already_holds(std::int64_t utime, std::int32_t position);
  /// It switches the torque off and reports it, until it is switched off and on.
  void fail(std::uint8_t hardware_error);

  void receive(std::span<const std::uint8_t> bytes, int host_baud, std::int64_t utime);
  std::vector<TimedByte> advance(std::int64_t utime, int host_baud);

  struct Sample {
    std::int64_t utime = 0;  ///< when its registers were read
    double position = 0.0;
  };
  /// The readings of the last seconds.
  [[nodiscard]] const std::deque<Sample>& samples() const { return samples_; }
  [[nodiscard]] double position() const { return position_; }
  [[nodiscard]] std::int32_t goal() const { return get(116); }
  /// Of the profile to the goal.
  [[nodiscard]] double rate_max_ticks_s() const;
  [[nodiscard]] bool torque() const { return table_[64] != 0; }
  [[nodiscard]] int torque_losses() const { return torque_losses_; }

 private:
  void boot(std::int64_t utime);
  void process_input();
  void execute(std::uint8_t instruction, std::span<const std::uint8_t> parameters,
               std::int64_t utime);
  std::uint8_t write(std::size_t address, std::span<const std::uint8_t> bytes);
  void answer(std::uint8_t error, std::span<const std::uint8_t> parameters, std::int64_t utime);
  void put(std::int64_t at_us, std::span<const std::uint8_t> bytes);
  void move(std::int64_t until);
  void refresh(std::int64_t utime);
  template <class Number>
  void set(std::size_t address, Number number);
  [[nodiscard]] std::int32_t get(std::size_t address) const;
  [[nodiscard]] double byte_us() const { return 1e7 / params_.baud; }

  Params params_;
  std::mt19937 random_{31};
  bool is_on_ = false;
  std::int64_t power_on_us_ = 0;
  std::int64_t booted_us_ = 0;
  std::int64_t moved_us_ = 0;
  double position_ = 2048.0;
  double velocity_ = 0.0;  ///< ticks/s
  int torque_losses_ = 0;
  std::array<std::uint8_t, 147> table_{};
  struct Received {
    std::int64_t utime = 0;
    std::uint8_t byte = 0;
  };
  std::deque<Received> input_;
  std::deque<TimedByte> line_;
  std::int64_t input_free_us_ = 0;
  std::deque<Sample> samples_;
};

}  // namespace adit
