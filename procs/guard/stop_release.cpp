// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/guard/stop_release.hpp"

#include <algorithm>

#include "common/sensing/seconds.hpp"

namespace adit {

bool StopLatch::evaluate(bool has_reason, std::optional<std::int64_t> command_us,
                         std::int64_t now_us) {
  if (has_reason || !reason_us_) reason_us_ = now_us;
  if (has_reason && !stopped_) {
    const bool is_soon = released_us_ && seconds(now_us - *released_us_) < kSoonS;
    hold_factor_ = is_soon ? std::min(2.0 * hold_factor_, kHoldFactorMax) : 1.0;
  }
  if (has_reason) stopped_ = true;
  const bool held = seconds(now_us - *reason_us_) >= hold_s_ * hold_factor_;
  if (stopped_ && held && command_us && *command_us > *reason_us_) {
    stopped_ = false;
    released_us_ = now_us;
  }
  return stopped_;
}

bool RetreatPermission::forbids(bool is_present, int commanded, int travelled,
                                std::int64_t now_us) {
  if (!is_present) {
    if (now_us - last_present_us_ > kClearAfterUs) entry_direction_.reset();
    if (travelled != 0) last_direction_ = travelled;
    return false;
  }
  last_present_us_ = now_us;
  if (!entry_direction_) entry_direction_ = last_direction_;
  const bool retreats = *entry_direction_ != 0 && commanded == -*entry_direction_;
  return !retreats;
}

}  // namespace adit
