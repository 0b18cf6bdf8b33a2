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

/// A SICK LMS-200 as its telegram listing describes it (SICK 8007954, "Telegrams for configuring
/// and operating the LMS2xx"), written from that and not from our driver. It knows no real time:
/// the caller says when bytes arrive and until when it wants those that leave.
class LmsEmulator {
 public:
  struct Params {
    double turn_s = 1.0 / 75.0;  ///< of the mirror; the laser has a clock of its own
    int baud_after_power_on = 9600;
    double boot_s = 2.0;  ///< until it reports that it was switched on
    std::string password = "SICK_LMS";
    std::uint8_t status = 0x10;  ///< of all responses
    double processing_s = 0.0;   ///< from the last beam to the first byte
  };

  /// Time of the first scan behind power on [µs].
  static constexpr std::int64_t kFirstScanUs = 4321;

  /// Reading of a beam, 13 bits. `scan`: number of the scan.
  using Reading = std::function<std::uint16_t(int scan, int beam)>;

  LmsEmulator(Params params, Reading reading);

  void power_on(std::int64_t utime);
  void power_off();

  /// It measures and sends since earlier, at this baud rate, as an earlier host has set it.
  void already_streams(std::int64_t utime, int baud);

  /// Bytes of the host, sent at its baud rate.
  void receive(std::span<const std::uint8_t> bytes, int host_baud, std::int64_t utime);

  /// What leaves until this time, as a host at its baud rate receives it: at another rate than that
  /// of the laser, arbitrary bytes.
  std::vector<TimedByte> advance(std::int64_t utime, int host_baud);

  /// Time of the first beam of each scan since the field of view was set, by its number [µs].
  [[nodiscard]] std::int64_t scan_start(int scan) const;
  [[nodiscard]] int scans_sent() const { return static_cast<int>(starts_.size()); }
  [[nodiscard]] int baud() const { return baud_; }
  [[nodiscard]] int configurations_written() const { return configurations_written_; }
  [[nodiscard]] int field_of_view_deg() const { return field_of_view_deg_; }

 private:
  enum class Mode : std::uint8_t { kInstallation = 0x00, kContinuous = 0x24, kOnRequest = 0x25 };
  struct Pending {
    std::int64_t start = 0;
    std::vector<std::uint8_t> bytes;
    int baud_after = 0;  ///< 0: as before
  };

  void parse(std::int64_t utime);
  void execute(std::span<const std::uint8_t> content, std::int64_t utime);
  void execute_mode(std::span<const std::uint8_t> content, std::int64_t utime);
  void answer(std::vector<std::uint8_t> content, std::int64_t utime, int baud_after = 0);
  void enqueue(std::vector<std::uint8_t> bytes, std::int64_t start, int baud_after);
  void measure(std::int64_t until);
  [[nodiscard]] int turns() const { return 100 / step_hundredths_; }
  [[nodiscard]] int beams() const { return 100 * field_of_view_deg_ / step_hundredths_ + 1; }
  [[nodiscard]] std::vector<std::uint8_t> frame(const std::vector<std::uint8_t>& content) const;
  [[nodiscard]] std::vector<std::uint8_t> scan_telegram(int scan) const;

  Params params_;
  Reading reading_;
  std::mt19937 random_{7};
  bool is_on_ = false;
  std::int64_t booted_ = 0;
  bool announced_ = false;
  Mode mode_ = Mode::kOnRequest;
  int baud_ = 9600;
  int field_of_view_deg_ = 180;
  int step_hundredths_ = 50;
  std::vector<std::uint8_t> configuration_;
  std::vector<std::uint8_t> input_;
  std::deque<Pending> pending_;
  std::deque<TimedByte> line_;
  std::int64_t line_free_ = 0;
  std::int64_t mirror_zero_ = 0;  ///< when the mirror began to turn
  std::int64_t next_scan_ = 0;    ///< that ends after the last call
  std::vector<std::int64_t> starts_;
  int configurations_written_ = 0;
};

}  // namespace adit
