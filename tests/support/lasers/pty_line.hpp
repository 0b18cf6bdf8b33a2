// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <random>
#include <span>
#include <vector>

namespace adit {

/// The far end of a serial line: a pseudo-terminal with a link to its near end, which a driver
/// opens as it opens /dev/ttyUSB0.
class PtyLine {
 public:
  /// Throws std::system_error.
  explicit PtyLine(std::filesystem::path link);
  ~PtyLine();
  PtyLine(const PtyLine&) = delete;
  PtyLine& operator=(const PtyLine&) = delete;

  /// As when the adapter is pulled out of the computer; a driver that has it open is told so.
  void unplug();
  void plug();
  [[nodiscard]] bool is_plugged() const { return master_ >= 0; }

  /// What the driver wrote.
  std::vector<std::uint8_t> read();
  void write(std::span<const std::uint8_t> bytes);

  /// To which the driver has set its end; 0 while it has none open.
  [[nodiscard]] int host_baud() const;

 private:
  std::filesystem::path link_;
  int master_ = -1;
};

/// Runs an emulated laser on such a line in real time.
template <class Emulator>
class PtyLaser {
 public:
  PtyLaser(std::filesystem::path link, Emulator& laser) : line_(std::move(link)), laser_(laser) {}

  double corrupt_share = 0.0;  ///< of the bytes to the driver

  PtyLine& line() { return line_; }

  /// To be called every millisecond or so. `utime`: now.
  void step(std::int64_t utime) {
    const int baud = line_.is_plugged() ? line_.host_baud() : 0;
    if (line_.is_plugged()) laser_.receive(line_.read(), baud, utime);
    std::vector<std::uint8_t> bytes;
    for (const auto& timed : laser_.advance(utime, baud)) bytes.push_back(damaged(timed.byte));
    if (line_.is_plugged()) line_.write(bytes);
  }

 private:
  std::uint8_t damaged(std::uint8_t byte) {
    if (std::uniform_real_distribution<>()(random_) >= corrupt_share) return byte;
    return static_cast<std::uint8_t>(random_());
  }

  PtyLine line_;
  Emulator& laser_;
  std::mt19937 random_{11};
};

}  // namespace adit
