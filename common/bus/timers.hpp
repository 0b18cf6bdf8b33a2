// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/bus/bus.hpp"

namespace adit {

/// Schedules the timers of a bus. Has no clock; the caller passes bus time.
class Timers {
 public:
  struct Tick {
    std::int64_t due_utime;
    TimerHandler handler;
  };

  /// Throws std::invalid_argument unless the period [µs] is positive.
  void add(std::int64_t period_us, TimerHandler handler);

  /// Removes the earliest tick due at `utime` from the schedule and returns it. The first tick of a
  /// timer is due immediately. Ticks more than ten seconds late are skipped, and a clock that is
  /// set back is followed.
  std::optional<Tick> next(std::int64_t utime);

  /// Time from `utime` to the next tick [µs], 0 if one is due; nothing without timers.
  [[nodiscard]] std::optional<std::int64_t> wait_us(std::int64_t utime) const;

 private:
  struct Timer {
    std::int64_t period_us;
    TimerHandler handler;
    std::optional<std::int64_t> due_utime;
  };

  std::vector<Timer> timers_;
};

}  // namespace adit
