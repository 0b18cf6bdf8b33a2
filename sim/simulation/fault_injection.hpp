// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <random>
#include <utility>
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

/// Delivery of readings: sorts them by time, drops some (packet loss), and shifts the times of
/// driver readings by the clock fault.
class ReadingQueue {
 public:
  /// `faults` must outlive this.
  ReadingQueue(const FaultSchedule& faults, std::uint64_t seed) : faults_(faults), random_(seed) {}

  /// `utime` is the true time of delivery. Readings of the same time keep the order of the calls.
  void add(std::int64_t utime, Reading reading);
  /// The readings added since the last call that are not lost.
  std::vector<Reading> take();

 private:
  bool is_lost(std::int64_t utime);

  const FaultSchedule& faults_;
  std::mt19937_64 random_;
  std::vector<std::pair<std::int64_t, Reading>> added_;
};

}  // namespace adit
