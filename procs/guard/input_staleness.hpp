// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>

#include "common/sensing/seconds.hpp"
#include "procs/guard/decimal_text.hpp"

namespace adit {

/// A time that only goes on [µs], made of bus time, which may be put back: the steps back are left
/// out. What was heard does not get younger by them, and so goes stale as it should.
class MonotonicTime {
 public:
  std::int64_t advance_to(std::int64_t bus_utime) {
    now_us_ += std::max<std::int64_t>(0, bus_utime - bus_utime_.value_or(bus_utime));
    bus_utime_ = bus_utime;
    return now_us_;
  }

  [[nodiscard]] std::int64_t now_us() const { return now_us_; }

  /// Of something that was measured at `utime`. A time that is yet to come counts as now.
  [[nodiscard]] std::int64_t monotonic_us(std::int64_t utime) const {
    return now_us_ - std::max<std::int64_t>(0, bus_utime_.value_or(utime) - utime);
  }

 private:
  std::int64_t now_us_ = 0;
  std::optional<std::int64_t> bus_utime_;
};

/// When a source was heard last, by MonotonicTime [µs].
class LastReceived {
 public:
  /// False for what is older than the last: it is no news.
  bool receive(std::int64_t at_us) {
    if (at_us_ && at_us < *at_us_) return false;
    at_us_ = at_us;
    return true;
  }

  [[nodiscard]] const std::optional<std::int64_t>& at_us() const { return at_us_; }

  /// Nothing where it was never heard.
  [[nodiscard]] std::optional<double> age_s(std::int64_t now_us) const {
    if (!at_us_) return std::nullopt;
    return seconds(now_us - *at_us_);
  }

  /// Heard, and not longer ago than that.
  [[nodiscard]] bool is_fresh(std::int64_t now_us, double timeout_s) const {
    return at_us_ && *age_s(now_us) <= timeout_s;
  }

  /// "laser front silent for 0.31 s", "no pose yet"; nothing while it is fresh.
  [[nodiscard]] std::optional<std::string> staleness(const char* source, std::int64_t now_us,
                                                     double timeout_s) const {
    if (!at_us_) return std::string("no ") + source + " yet";
    if (is_fresh(now_us, timeout_s)) return std::nullopt;
    return std::string(source) + " silent for " + decimal_text(*age_s(now_us), 2) + " s";
  }

  /// As `silence`, of a source that need not be there: once heard, it must go on.
  [[nodiscard]] std::optional<std::string> staleness_if_received(const char* source,
                                                                 std::int64_t now_us,
                                                                 double timeout_s) const {
    return at_us_ ? staleness(source, now_us, timeout_s) : std::nullopt;
  }

 private:
  std::optional<std::int64_t> at_us_;
};

}  // namespace adit
