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

/// The simulated time: all measurements up to it have been sent.
struct SimTime {
  std::int64_t utime = 0;  ///< [µs since the epoch]

  friend bool operator==(const SimTime&, const SimTime&) = default;
};

/// A stage has handled every message that it received before this time.
struct SimTimeDone {
  std::int64_t utime = 0;  ///< that of the SimTime [µs since the epoch]
  std::string stage;

  friend bool operator==(const SimTimeDone&, const SimTimeDone&) = default;
};

sim_time_t to_message(const SimTime& time);
sim_time_done_t to_message(const SimTimeDone& done);

/// Rejects an implausible time.
Result<SimTime> from_message(const sim_time_t& message);

/// Rejects an implausible time and an empty stage.
Result<SimTimeDone> from_message(const sim_time_done_t& message);

run_state_t to_message(const RunState& state);

/// Rejects an implausible time and a distance that is negative or not finite.
Result<RunState> from_message(const run_state_t& message);

}  // namespace adit
