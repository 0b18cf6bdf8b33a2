// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "sim/world/world.hpp"
#include "tests/support/scores/mission_log.hpp"
#include "tests/support/worlds/planar_mine.hpp"

namespace adit::test {

/// How a mission went, by the truth.
struct MissionScore {
  std::string outcome;                 ///< home, stopped, stranded, timed out, failed or crashed
  std::string reason;                  ///< for that, a sentence
  double distance_from_start_m = 0.0;  ///< of the true body from the start, at the end
  double farthest_m = 0.0;             ///< of the true body from the start, straight
  double corridor_m = 0.0;             ///< that can be reached without wading
  double covered_share = 0.0;          ///< of that, from within 8 m
  double missed_m = 0.0;               ///< of that, farther than 2 m from all that was seen
  double certainly_missed_m = 0.0;     ///< the same of what the vehicle with some room can reach
  double distance_travelled_m = 0.0;   ///< true
  double simulated_s = 0.0;
  double wall_s = 0.0;
  int scans = 0;
  double rmse_m = 0.0;            ///< of T_map_body by the last graph, laid upon the truth at first
  double rmse_estimated_m = 0.0;  ///< as it was believed at the time
  double length_ratio = 0.0;      ///< of the way by the last graph to the true one
  int verdicts = 0;               ///< that a stub is blocked
  int false_verdicts = 0;         ///< where the vehicle with some room fits beyond it
  int unconfirmed = 0;            ///< stubs given up that nobody saw to be blocked
  int route_home_verdicts = 0;    ///< that the way home is, or where no stub was
  bool complete = false;          ///< said of the exploration
  int rescans = 0;                ///< second looks from the same place
  int back_offs = 0;
  int guard_stops = 0;

  [[nodiscard]] bool false_complete() const { return complete && missed_m > 2.0; }
};

/// The truth of a world that a mission is held against. Costs a search for what can be reached.
class MissionTruth {
 public:
  static constexpr double kCoverageRangeM = 8.0;   ///< from which corridor counts as seen
  static constexpr double kBeyondFrontierM = 1.5;  ///< of a stub, where what is blocked begins
  static constexpr double kMarginM = 0.1;          ///< round the vehicle that is sure to fit

  explicit MissionTruth(const World& world);

  /// But for the wall time.
  [[nodiscard]] MissionScore score(const MissionLog& log) const;

 private:
  void add_coverage(const MissionLog& log, MissionScore& score) const;
  void add_verdicts(const MissionLog& log, MissionScore& score) const;

  PlanarMine mine_;
  PlanarMine mine_with_margin_;  ///< the same for a vehicle with room
};

}  // namespace adit::test
