// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/bus/bus.hpp"

namespace adit {

/// When the timers of a bus are due. Knows no clock: bus time is given to it.
class Timers {
 public:
  struct Tick {
    std::int64_t due_utime;
    TimerHandler handler;
  };

  /// Throws std::invalid_argument unless the period [µs] is positive.
  void add(std::int64_t period_us, TimerHandler handler);

  /// Takes the earliest tick that is due at `utime` off the schedule. The first tick of a timer is
  /// due at once. Ticks more than ten seconds late are left out, and a clock that was put back is
  /// followed.
  std::optional<Tick> next(std::int64_t utime);

  /// How long from `utime` to the next tick [µs], 0 if one is due; nothing without timers.
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
