// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "tests/support/lasers/timed_byte.hpp"

namespace adit {

/// A VN-100 as its user manual describes it (ASCII protocol, registers 1, 5, 6, 7 and 30), written
/// from that and not from our driver. It knows no real time: the caller says when bytes arrive and
/// until when it wants those that leave.
class ImuEmulator {
 public:
  struct Params {
    double boot_s = 0.5;
    double clock_rate = 1.0;  ///< of its output, by the true time
  };

  /// Acceleration [m/s²], rates [rad/s] in the frame of the unit, of a numbered output.
  using Reading = std::function<std::array<double, 6>(int number)>;

  ImuEmulator(Params params, Reading reading) : params_(params), reading_(std::move(reading)) {}

  void power_on(std::int64_t utime);
  void power_off();
  /// It sends since earlier, with the settings of its flash memory but for the baud rate.
  void already_streams(std::int64_t utime, int baud);

  void receive(std::span<const std::uint8_t> bytes, int host_baud, std::int64_t utime);
  std::vector<TimedByte> advance(std::int64_t utime, int host_baud);

  /// When each output was measured, by its number [µs].
  [[nodiscard]] const std::deque<std::int64_t>& starts() const { return starts_; }
  [[nodiscard]] int first_number() const { return next_number_ - static_cast<int>(starts_.size()); }
  [[nodiscard]] int baud() const { return baud_; }

 private:
  void execute(const std::string& text, std::int64_t utime);
  void send_line(const std::string& text, std::int64_t utime);
  void measure(std::int64_t until);
  [[nodiscard]] std::string output_line(int number) const;

  Params params_;
  Reading reading_;
  std::mt19937 random_{37};
  bool is_on_ = false;
  std::int64_t booted_us_ = 0;
  int baud_ = 115200;
  int baud_after_ = 0;            ///< behind what is on the line
  std::map<int, int> registers_;  ///< 6: kind of output, 7: rate, 30: checksum
  double next_us_ = 0.0;
  int next_number_ = 0;
  std::deque<std::int64_t> starts_;
  std::string input_;
  std::deque<TimedByte> line_;
  std::int64_t line_free_us_ = 0;
};

}  // namespace adit
