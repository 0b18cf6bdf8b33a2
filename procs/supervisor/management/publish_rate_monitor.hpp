// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>

namespace adit {

/// Whether messages come often enough: over the last two seconds, or two periods where these are
/// longer, as many as the rate asks for, less one. So a rate well below the usual one is asked for.
/// The time for which it waits for the disk does not count, up to a minute in a row.
class PublishRateMonitor {
 public:
  explicit PublishRateMonitor(double rate_hz);

  void on_message(std::int64_t now_us);
  /// It could not publish for so long, until now.
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
