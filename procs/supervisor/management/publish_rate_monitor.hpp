// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>

namespace adit {

/// Checks a minimum message rate: the messages of the last two seconds, or of two periods if
/// longer, must be at most one fewer than the rate requires. The configured rate should be well
/// below the nominal one. Time that the process is blocked on the disk does not count, up to one
/// minute without a message.
class PublishRateMonitor {
 public:
  explicit PublishRateMonitor(double rate_hz);

  void on_message(std::int64_t now_us);
  /// The process was blocked for `blocked_us` until `now_us`.
  void add_blocked_time(std::int64_t now_us, std::int64_t blocked_us);
  void reset();
  [[nodiscard]] bool is_met(std::int64_t now_us) const;

 private:
  std::int64_t window_us_;
  std::size_t needed_;
  std::deque<std::int64_t> times_us_;  // the newest `needed_`
  std::int64_t blocked_us_ = 0;        // since the newest
};

}  // namespace adit
