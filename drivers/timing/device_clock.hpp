// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "drivers/timing/clock_filter.hpp"

namespace adit {

/// The clock of a device that stamps its readings, by the clock of the computer. ClockFilter finds
/// its rate and phase from the arrivals but for the constant part of their delay. That follows from
/// a time that the device was asked for, whose answer is no earlier than the question; without one
/// it is what the caller says.
class DeviceClock {
 public:
  /// The device was asked for its time: the question left and the answer arrived at these times by
  /// the computer [µs]. Of several questions the one with the quickest answer counts.
  void add_answer(std::int64_t device_us, std::int64_t asked_us, std::int64_t answered_us);

  /// A reading with its stamp by the device arrived [µs]. In order of both.
  void add_arrival(std::int64_t device_us, std::int64_t arrival_us);

  /// Time of the stamp by the computer [µs]. `delay_us`: constant part of the delay from a stamp to
  /// its arrival, used if the device was not asked. There was an arrival before.
  [[nodiscard]] std::int64_t utime(std::int64_t device_us, double delay_us) const;

  /// Uncertainty of the answer that counts, half of the time it took [µs]; nothing without one.
  [[nodiscard]] std::optional<double> uncertainty_us() const;

  void reset() { *this = DeviceClock(); }

 private:
  struct Answer {
    std::int64_t device_us = 0;
    double utime = 0.0;
    std::int64_t took_us = 0;
  };

  ClockFilter arrivals_;
  std::optional<Answer> answer_;
  double delay_us_ = 0.0;  ///< from a stamp to its arrival, by the answer
};

}  // namespace adit
