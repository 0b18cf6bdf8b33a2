// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "sim/simulation/reading.hpp"
#include "sim/simulation/simulation_params.hpp"

namespace adit {

/// What is wrong at which time. Those faults that happen to processes are no part of it.
class FaultSchedule {
 public:
  /// Throws std::invalid_argument for a laser that is neither front nor rear, and a share beyond
  /// 0 to 1.
  FaultSchedule(const std::vector<FaultDescription>& faults, std::int64_t start_utime);

  [[nodiscard]] bool alive(SimLaser laser, std::int64_t utime) const;
  /// By how much the clock of the sensors is ahead of the true time `utime`.
  [[nodiscard]] std::int64_t clock_ahead_us(std::int64_t utime) const;
  /// Of all messages that are lost.
  [[nodiscard]] double loss_share(std::int64_t utime) const;

 private:
  struct Fault {
    std::int64_t utime = 0;
    FaultDescription description;
  };

  std::vector<Fault> faults_;  ///< in order of time
};

}  // namespace adit
