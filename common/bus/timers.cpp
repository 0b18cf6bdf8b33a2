// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/bus/timers.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace adit {
namespace {

constexpr std::int64_t kCatchUpMaxUs = 10'000'000;

}  // namespace

void Timers::add(std::int64_t period_us, TimerHandler handler) {
  if (period_us <= 0) throw std::invalid_argument("a timer needs a positive period");
  timers_.push_back({period_us, std::move(handler), std::nullopt});
}

std::optional<Timers::Tick> Timers::next(std::int64_t utime) {
  Timer* earliest = nullptr;
  for (Timer& timer : timers_) {
    const std::int64_t due = timer.due_utime.value_or(utime);
    const bool stale = due < utime - kCatchUpMaxUs || due > utime + timer.period_us;
    timer.due_utime = stale ? utime : due;
    if (!earliest || *timer.due_utime < *earliest->due_utime) earliest = &timer;
  }
  if (!earliest || *earliest->due_utime > utime) return std::nullopt;
  const std::int64_t due = *earliest->due_utime;
  earliest->due_utime = due + earliest->period_us;
  return Tick{due, earliest->handler};
}

std::optional<std::int64_t> Timers::wait_us(std::int64_t utime) const {
  std::optional<std::int64_t> wait;
  for (const Timer& timer : timers_) {
    const std::int64_t until = timer.due_utime.value_or(utime) - utime;
    wait = std::clamp<std::int64_t>(until, 0, wait.value_or(timer.period_us));
  }
  return wait;
}

}  // namespace adit
