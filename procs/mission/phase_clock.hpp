// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "common/sensing/seconds.hpp"

namespace adit {

/// The age of a mission and of its phase, and when requests are repeated. Times are µs since the
/// epoch.
class PhaseClock {
 public:
  static constexpr double kRequestPeriodS = 2.0;  ///< a message may be lost

  /// Continues a mission that began at `start_utime`.
  void restore(std::int64_t start_utime) { start_utime_ = start_utime; }

  void set_time(std::int64_t utime) {
    utime_ = utime;
    if (!start_utime_) start_utime_ = utime;
    if (!phase_utime_) phase_utime_ = utime;
  }

  void begin_phase() {
    phase_utime_ = utime_;
    requested_utime_.reset();
  }

  /// The time of the newest set_time(); empty before the first.
  [[nodiscard]] const std::optional<std::int64_t>& utime() const { return utime_; }
  /// When the phase began; empty before the first set_time().
  [[nodiscard]] const std::optional<std::int64_t>& phase_utime() const { return phase_utime_; }

  /// Since a time that this clock has had; empty for none.
  [[nodiscard]] std::optional<double> age_s(const std::optional<std::int64_t>& since_utime) const {
    if (!utime_ || !since_utime) return std::nullopt;
    return seconds(*utime_ - *since_utime);
  }
  [[nodiscard]] double mission_age_s() const { return age_s(start_utime_).value_or(0.0); }
  [[nodiscard]] double phase_age_s() const { return age_s(phase_utime_).value_or(0.0); }

  /// Returns true at the start of a phase and every kRequestPeriodS after it.
  [[nodiscard]] bool is_request_due() {
    const auto age = age_s(requested_utime_);
    if (age && *age < kRequestPeriodS) return false;
    requested_utime_ = utime_;
    return true;
  }

 private:
  std::optional<std::int64_t> utime_;
  std::optional<std::int64_t> start_utime_;
  std::optional<std::int64_t> phase_utime_;
  std::optional<std::int64_t> requested_utime_;  ///< of the newest request of this phase
};

}  // namespace adit
