// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "drivers/timing/clock_filter.hpp"

namespace adit {

/// The clock of a laser that sends no time: its mirror. Scans end at whole multiples of the scan
/// period, some are not sent, others are lost; which one arrived follows from the time of arrival,
/// since a scan may be late but not early. ClockFilter finds the phase and the true period.
class ScanCounter {
 public:
  /// Nominal period of the scans [µs], positive; the true one is within 1 % of it.
  explicit ScanCounter(double period_us);

  /// Time at which a scan would have arrived with the least delay [µs]. `scans_min`: how many
  /// periods it is after the one before, at least. Nothing if the scan cannot be told from the one
  /// before, as when that one was late by a whole period; the caller drops it.
  std::optional<std::int64_t> arrival_us(std::int64_t arrival_us, std::int64_t scans_min = 1);

  /// The period by the clock of the computer [µs].
  [[nodiscard]] double period_us() const { return period_us_ * clock_.rate(); }

  /// As at the beginning: the laser was started again.
  void reset();

 private:
  [[nodiscard]] std::int64_t device_us(std::int64_t scan) const;
  [[nodiscard]] std::int64_t scan_at(std::int64_t arrival_us) const;

  double period_us_;
  ClockFilter clock_;
  std::int64_t first_arrival_us_ = 0;
  std::int64_t last_scan_ = 0;
  int contradictions_ = 0;  ///< one after the other
};

}  // namespace adit
