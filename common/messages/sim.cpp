// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/sim.hpp"

#include "common/messages/fields/diagnostics_fields.hpp"

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
  if (const auto reason = implausible_field(message); !reason.empty()) return Rejected{reason};
  return SimTime{message.utime};
}

Result<SimTimeDone> from_message(const sim_time_done_t& message) {
  if (const auto reason = implausible_field(message); !reason.empty()) return Rejected{reason};
  return SimTimeDone{message.utime, message.stage};
}

run_state_t to_message(const RunState& state) {
  run_state_t message;
  message.utime = state.utime;
  message.distance_travelled_m = state.distance_travelled_m;
  message.failure = state.failure;
  return message;
}

Result<RunState> from_message(const run_state_t& message) {
  if (const auto reason = implausible_field(message); !reason.empty()) return Rejected{reason};
  return RunState{message.utime, message.distance_travelled_m, message.failure};
}

}  // namespace adit
