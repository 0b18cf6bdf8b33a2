// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace adit {

/// Two readings of one sensor may be exchanged in a log by at most this time [µs].
inline constexpr std::int64_t kReorderWindowUs = 1'000'000;

/// Counts what is wrong with one clock of a log, in constant memory. A reading is usable if its
/// time is positive, differs from that of the previous reading, and is at most kReorderWindowUs
/// before the newest time.
class ClockStatistics {
 public:
  /// `utime` is 0 where the time is missing [µs]; `position` is the number of scans before the
  /// reading.
  void add(std::int64_t utime, std::size_t position);

  [[nodiscard]] std::size_t readings() const { return readings_; }
  [[nodiscard]] std::size_t usable() const { return readings_ - missing_ - repeated_ - set_back_; }
  /// Readings before an earlier one by at most the window: they only need to be sorted.
  [[nodiscard]] std::size_t late() const { return late_; }
  [[nodiscard]] double usable_share() const;
  /// "1987 of 1988 repeat the one before"; empty if all readings are usable.
  [[nodiscard]] std::string defects() const;
  /// First time that is not missing.
  [[nodiscard]] std::optional<std::int64_t> first_utime() const { return first_utime_; }
  /// Mean time from scan to scan between the first and the last change of the clock, so that the
  /// resolution of the clock does not matter [µs]; nothing if the clock changes less than twice.
  [[nodiscard]] std::optional<double> scan_period_us() const;

 private:
  struct Change {
    std::int64_t utime = 0;
    std::size_t position = 0;
  };

  std::size_t readings_ = 0;
  std::size_t missing_ = 0;
  std::size_t repeated_ = 0;
  std::size_t set_back_ = 0;
  std::size_t late_ = 0;
  std::optional<std::int64_t> first_utime_;
  std::optional<std::int64_t> previous_;
  std::int64_t latest_ = 0;
  std::optional<Change> first_change_;
  std::optional<Change> last_change_;
};

}  // namespace adit
