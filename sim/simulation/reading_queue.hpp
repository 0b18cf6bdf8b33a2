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

/// What becomes of readings on their way: they are put in order, some get lost, and those of
/// drivers get the time of a clock that may have jumped.
class ReadingQueue {
 public:
  /// `faults` must outlive this.
  ReadingQueue(const FaultSchedule& faults, std::uint64_t seed) : faults_(faults), random_(seed) {}

  /// `utime`: when it is delivered, true time. At the same time in the order of the calls.
  void add(std::int64_t utime, Reading reading);
  /// Those that arrive of what was added since the last call.
  std::vector<Reading> take();

 private:
  bool is_lost(std::int64_t utime);

  const FaultSchedule& faults_;
  std::mt19937_64 random_;
  std::vector<std::pair<std::int64_t, Reading>> added_;
};

}  // namespace adit
