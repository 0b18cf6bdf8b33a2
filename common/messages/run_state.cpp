// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/run_state.hpp"

#include "common/messages/checks.hpp"

namespace adit {

run_state_t to_message(const RunState& state) {
  run_state_t message;
  message.utime = state.utime;
  message.travelled_m = state.travelled_m;
  message.failure = state.failure;
  return message;
}

Result<RunState> from_message(const run_state_t& message) {
  if (!is_plausible_utime(message.utime)) return Refused{kImplausibleTime};
  if (!std::isfinite(message.travelled_m)) return Refused{"way is not finite"};
  if (message.travelled_m < 0.0) return Refused{"way is negative"};
  return RunState{message.utime, message.travelled_m, message.failure};
}

}  // namespace adit
