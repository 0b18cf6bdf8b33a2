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
class PublishRate {
 public:
  explicit PublishRate(double rate_hz);

  void heard(std::int64_t now_us);
  /// It could not publish for so long, until now.
  void excuse(std::int64_t now_us, std::int64_t waited_us);
  void forget();
  [[nodiscard]] bool is_kept(std::int64_t now_us) const;

 private:
  std::int64_t window_us_;
  std::size_t needed_;
  std::deque<std::int64_t> times_us_;  // the newest `needed_`
  std::int64_t excused_us_ = 0;        // since the newest
};

}  // namespace adit
