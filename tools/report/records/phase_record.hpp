// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/bus/bus.hpp"
#include "common/types/mission.hpp"

namespace adit {

/// A stretch of time that the mission spent in one phase.
struct PhaseInterval {
  MissionPhase phase;                     ///< as it began
  std::int64_t to_utime = 0;              ///< where the next began, or the log ended
  double end_distance_travelled_m = 0.0;  ///< way at its end

  [[nodiscard]] double seconds() const {
    return 1e-6 * static_cast<double>(to_utime - phase.utime);
  }
};

/// Listens to PHASE. Where a mission never said how it stands, what its stages did stands for that:
/// it was scanning from a SCAN_REQUEST to its CLOUD, and executing while driving said so.
class PhaseRecord {
 public:
  /// `bus` must outlive this.
  explicit PhaseRecord(Bus& bus);

  /// To be called when the log has ended, then.
  void finish(std::int64_t end_utime);

  [[nodiscard]] const std::vector<PhaseInterval>& intervals() const {
    return reported_.empty() ? inferred_ : reported_;
  }
  /// Whether the mission said so itself.
  [[nodiscard]] bool reported() const { return !reported_.empty(); }
  /// As it stands at last; nothing without PHASE.
  [[nodiscard]] const std::optional<MissionPhase>& last() const { return last_; }
  /// When it turned around.
  [[nodiscard]] std::optional<std::int64_t> homeward_utime() const { return homeward_utime_; }

 private:
  void on_phase(const MissionPhase& phase);
  void infer(std::int64_t utime, Phase phase);

  std::vector<PhaseInterval> reported_;
  std::vector<PhaseInterval> inferred_;
  std::optional<MissionPhase> last_;
  std::optional<std::int64_t> homeward_utime_;
};

}  // namespace adit
