// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/bus/bus.hpp"
#include "common/records/time_budget.hpp"
#include "common/sensing/seconds.hpp"
#include "common/types/mission.hpp"

namespace adit {

/// An interval of time in one phase.
struct PhaseInterval {
  MissionPhase phase;                     ///< at the start of the interval
  std::int64_t to_utime = 0;              ///< start of the next interval, or end of the log
  double end_distance_travelled_m = 0.0;  ///< at the end of the interval

  [[nodiscard]] double duration_s() const { return seconds(to_utime - phase.utime); }
};

/// Collects the phases of a mission from PHASE. For a log without PHASE it infers them: scan from
/// SCAN_REQUEST to CLOUD, execute while DRIVING_STATE is driving, waiting otherwise.
class PhaseRecord {
 public:
  /// `bus` must outlive this.
  explicit PhaseRecord(Bus& bus);

  /// Must be called at the end of the log. Ends the last interval.
  void finish(std::int64_t end_utime);

  [[nodiscard]] const std::vector<PhaseInterval>& intervals() const {
    return reported_.empty() ? inferred_ : reported_;
  }
  /// True if the intervals are from PHASE, false if they are inferred.
  [[nodiscard]] bool reported() const { return !reported_.empty(); }
  /// By PHASE, VEHICLE_STATE and POSE; empty without PHASE.
  [[nodiscard]] const TimeBudget& budget() const { return budget_; }
  /// Last PHASE; nothing without PHASE.
  [[nodiscard]] const std::optional<MissionPhase>& last() const { return last_; }
  /// Time of the decision to return home.
  [[nodiscard]] std::optional<std::int64_t> return_home_utime() const { return return_home_utime_; }

 private:
  void on_phase(const MissionPhase& phase);
  void infer(std::int64_t utime, Phase phase);

  std::vector<PhaseInterval> reported_;
  std::vector<PhaseInterval> inferred_;
  TimeBudget budget_;
  std::optional<MissionPhase> last_;
  std::optional<std::int64_t> return_home_utime_;
};

}  // namespace adit
