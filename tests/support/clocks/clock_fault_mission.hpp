// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/types/mission.hpp"
#include "tests/support/clocks/clock_fault_bus.hpp"

namespace adit::test {

/// A mission in a small random mine in which a clock of the robot fails.
struct ClockFaultCase {
  int number = 0;
  int mine = 0;  ///< its seed
  ClockFault fault;
};

/// What happened in it.
struct ClockFaultResult {
  MissionOutcome outcome = MissionOutcome::kInProgress;  ///< as the robot claims
  std::string reason;                                    ///< of its last phase
  std::string failure;                                   ///< a collision; empty without
  double distance_from_start_m = 0.0;                    ///< true, in space, at the end
  double simulated_s = 0.0;
  std::int64_t changed = 0;   ///< stamps that the fault changed
  std::int64_t rejected = 0;  ///< messages that stages rejected, more than before the fault
  std::string reported;       ///< by the first heartbeat since the fault that names a channel of it
  double blind_s = 0.0;  ///< longest time without POSE before the mission ended, since the fault
  /// The same since its cause is gone; empty if it does not end.
  std::optional<double> blind_after_s;

  [[nodiscard]] bool claims_home_falsely() const;
  /// A false claim, a collision or over five seconds without POSE after the cause is gone.
  [[nodiscard]] bool is_failure() const;
};

/// All combinations of channel, fault and duration, in an order that depends on `seed` alone, each
/// at a random time of its mission. The first of them are missions without a fault, one
/// for each mine.
std::vector<ClockFaultCase> clock_fault_cases(std::uint64_t seed);

/// Runs the mission in this process; `folder` is for its journals.
ClockFaultResult run_clock_fault(const ClockFaultCase& fault_case,
                                 const std::filesystem::path& folder);

}  // namespace adit::test
