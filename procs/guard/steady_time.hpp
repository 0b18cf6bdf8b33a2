// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

namespace adit {

/// A time that only goes on [µs], made of bus time, which may be put back: the steps back are left
/// out. What was heard does not get younger by them, and so goes stale as it should.
class SteadyTime {
 public:
  std::int64_t go_on_to(std::int64_t bus_utime) {
    now_us_ += std::max<std::int64_t>(0, bus_utime - bus_utime_.value_or(bus_utime));
    bus_utime_ = bus_utime;
    return now_us_;
  }

  [[nodiscard]] std::int64_t now_us() const { return now_us_; }

  /// Of something that was measured at `utime`. A time that is yet to come counts as now.
  [[nodiscard]] std::int64_t of(std::int64_t utime) const {
    return now_us_ - std::max<std::int64_t>(0, bus_utime_.value_or(utime) - utime);
  }

 private:
  std::int64_t now_us_ = 0;
  std::optional<std::int64_t> bus_utime_;
};

}  // namespace adit
