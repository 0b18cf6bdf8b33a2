// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <utility>

#include "tools/log_times/clock_statistics.hpp"

namespace adit {

/// Puts readings in order of time that are exchanged by at most kReorderWindowUs; equal times keep
/// their order. Holds the readings of that window. A reading that is older than the window (the
/// clock was set back) follows all before it.
template <class Reading>
class ReorderBuffer {
 public:
  using Output = std::function<void(Reading&&)>;

  explicit ReorderBuffer(Output output) : output_(std::move(output)) {}

  void add(std::int64_t utime, Reading reading) {
    const bool set_back = !held_.empty() && utime < held_.rbegin()->first - kReorderWindowUs;
    if (set_back) flush();
    held_.emplace(utime, std::move(reading));
    release(held_.rbegin()->first - kReorderWindowUs);
  }

  /// Outputs the rest.
  void flush() {
    for (auto& [utime, reading] : held_) output_(std::move(reading));
    held_.clear();
  }

 private:
  void release(std::int64_t until_utime) {
    while (held_.begin()->first <= until_utime) {
      output_(std::move(held_.begin()->second));
      held_.erase(held_.begin());
    }
  }

  Output output_;
  std::multimap<std::int64_t, Reading> held_;
};

}  // namespace adit
