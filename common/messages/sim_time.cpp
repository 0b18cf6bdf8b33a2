// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/sim_time.hpp"

#include "common/messages/checks.hpp"

namespace adit {

sim_time_t to_message(const SimTime& time) {
  sim_time_t message;
  message.utime = time.utime;
  return message;
}

sim_time_done_t to_message(const SimTimeDone& done) {
  sim_time_done_t message;
  message.utime = done.utime;
  message.stage = done.stage;
  return message;
}

Result<SimTime> from_message(const sim_time_t& message) {
  if (!is_plausible_utime(message.utime)) return Refused{kImplausibleTime};
  return SimTime{message.utime};
}

Result<SimTimeDone> from_message(const sim_time_done_t& message) {
  if (!is_plausible_utime(message.utime)) return Refused{kImplausibleTime};
  if (message.stage.empty()) return Refused{"no stage"};
  return SimTimeDone{message.utime, message.stage};
}

}  // namespace adit
