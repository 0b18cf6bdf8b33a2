// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "common/sensing/seconds.hpp"

namespace adit {

/// Monotonic time [µs], derived from bus time. Bus time may be set back; such steps are left out,
/// so that data does not become younger and goes stale as it should.
class MonotonicTime {
 public:
  std::int64_t advance_to(std::int64_t bus_utime) {
    now_us_ += std::max<std::int64_t>(0, bus_utime - bus_utime_.value_or(bus_utime));
    bus_utime_ = bus_utime;
    return now_us_;
  }

  [[nodiscard]] std::int64_t now_us() const { return now_us_; }

  /// The monotonic time of a measurement; a time in the future counts as now.
  [[nodiscard]] std::int64_t monotonic_us(std::int64_t utime) const {
    return now_us_ - std::max<std::int64_t>(0, bus_utime_.value_or(utime) - utime);
  }

 private:
  std::int64_t now_us_ = 0;
  std::optional<std::int64_t> bus_utime_;
};

/// The time of the newest data of a source, in MonotonicTime [µs].
class LastReceived {
 public:
  /// False for data older than the newest.
  bool receive(std::int64_t at_us) {
    if (at_us_ && at_us < *at_us_) return false;
    at_us_ = at_us;
    return true;
  }

  [[nodiscard]] const std::optional<std::int64_t>& at_us() const { return at_us_; }

  /// Nothing if no data was received.
  [[nodiscard]] std::optional<double> age_s(std::int64_t now_us) const {
    if (!at_us_) return std::nullopt;
    return seconds(now_us - *at_us_);
  }

  [[nodiscard]] bool is_fresh(std::int64_t now_us, double timeout_s) const {
    return at_us_ && *age_s(now_us) <= timeout_s;
  }

  /// "laser front stale for 0.31 s" or "no pose received yet"; nothing while the data is fresh. Of
  /// time stamps that no outage explains (a clock that starts at the epoch) no age is stated.
  [[nodiscard]] std::optional<std::string> staleness(const char* source, std::int64_t now_us,
                                                     double timeout_s) const {
    if (!at_us_) return fmt::format("no {} received yet", source);
    if (is_fresh(now_us, timeout_s)) return std::nullopt;
    if (*age_s(now_us) > kAgeStatedMaxS) {
      return fmt::format("{} stale: its time stamps are more than a day old", source);
    }
    return fmt::format("{} stale for {:.2f} s", source, *age_s(now_us));
  }

  /// As staleness(), of an optional source: it counts once data was received.
  [[nodiscard]] std::optional<std::string> staleness_if_received(const char* source,
                                                                 std::int64_t now_us,
                                                                 double timeout_s) const {
    return at_us_ ? staleness(source, now_us, timeout_s) : std::nullopt;
  }

 private:
  static constexpr double kAgeStatedMaxS = 86400.0;

  std::optional<std::int64_t> at_us_;
};

}  // namespace adit
