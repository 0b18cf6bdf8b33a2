// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "adit/run_state_t.hpp"
#include "adit/sim_time_done_t.hpp"
#include "adit/sim_time_t.hpp"

#include "common/messages/result.hpp"
#include "common/types/vehicle_state.hpp"

namespace adit {

/// What time it is, where time is simulated: all that was measured until then has been sent.
struct SimTime {
  std::int64_t utime = 0;  ///< [µs since the epoch]

  friend bool operator==(const SimTime&, const SimTime&) = default;
};

/// A stage has handled all that came to it before that time did.
struct SimTimeDone {
  std::int64_t utime = 0;  ///< that of the SimTime [µs since the epoch]
  std::string stage;

  friend bool operator==(const SimTimeDone&, const SimTimeDone&) = default;
};

sim_time_t to_message(const SimTime& time);
sim_time_done_t to_message(const SimTimeDone& done);

/// Refused: an implausible time.
Result<SimTime> from_message(const sim_time_t& message);

/// Refused: an implausible time, no stage.
Result<SimTimeDone> from_message(const sim_time_done_t& message);

run_state_t to_message(const RunState& state);

/// Refused: an implausible time, a way that is negative or not finite.
Result<RunState> from_message(const run_state_t& message);

}  // namespace adit
