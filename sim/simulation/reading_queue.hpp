// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "sim/simulation/fault_schedule.hpp"
#include "sim/simulation/reading.hpp"

namespace adit {

/// Delivery of readings: sorts them by time, drops some (packet loss), and shifts the times of
/// driver readings by the clock fault.
class ReadingQueue {
 public:
  /// `faults` must outlive this.
  ReadingQueue(const FaultSchedule& faults, std::uint64_t seed) : faults_(faults), random_(seed) {}

  /// `utime` is the true time of delivery. Readings of the same time keep the order of the calls.
  void add(std::int64_t utime, Reading reading);
  /// The readings added since the last call that are not lost.
  std::vector<Reading> take();

 private:
  bool is_lost(std::int64_t utime);

  const FaultSchedule& faults_;
  std::mt19937_64 random_;
  std::vector<std::pair<std::int64_t, Reading>> added_;
};

}  // namespace adit
