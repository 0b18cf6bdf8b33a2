// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/guard/stop_latch.hpp"

#include "common/sensing/seconds.hpp"

namespace adit {

bool StopLatch::judge(bool has_reason, std::optional<std::int64_t> command_us,
                      std::int64_t now_us) {
  if (has_reason || !reason_us_) reason_us_ = now_us;
  if (has_reason) stopped_ = true;
  const bool held = seconds(now_us - *reason_us_) >= hold_s_;
  if (held && command_us && *command_us > *reason_us_) stopped_ = false;
  return stopped_;
}

}  // namespace adit
