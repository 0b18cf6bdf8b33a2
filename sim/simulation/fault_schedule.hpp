// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "sim/simulation/reading.hpp"
#include "sim/simulation/simulation_params.hpp"

namespace adit {

/// The injected faults that are active at a time. Faults of processes are ignored (ProcessFaults).
class FaultSchedule {
 public:
  /// Throws std::invalid_argument for a laser other than front and rear, and a fraction outside 0
  /// to 1.
  FaultSchedule(const std::vector<FaultDescription>& faults, std::int64_t start_utime);

  [[nodiscard]] bool alive(SimLaser laser, std::int64_t utime) const;
  /// Offset of the sensors' clock from the true time `utime`.
  [[nodiscard]] std::int64_t clock_ahead_us(std::int64_t utime) const;
  /// Fraction of all messages that is lost.
  [[nodiscard]] double loss_share(std::int64_t utime) const;

 private:
  struct Fault {
    std::int64_t utime = 0;
    FaultDescription description;
  };

  std::vector<Fault> faults_;  ///< sorted by time
};

}  // namespace adit
