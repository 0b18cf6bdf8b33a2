// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <string>

#include "sim/world/world.hpp"
#include "tests/support/scores/mission_log.hpp"
#include "tests/support/worlds/planar_mine.hpp"

namespace adit::test {

/// The result of a mission, evaluated against ground truth.
struct MissionScore {
  std::string outcome;                 ///< home, stopped, stranded, timed out, failed or crashed
  std::string reason;                  ///< of the outcome, a sentence
  double distance_from_start_m = 0.0;  ///< true, in three dimensions, at the end
  double farthest_m = 0.0;             ///< true, largest straight distance from the start
  double relief_m = 0.0;               ///< true, from the lowest to the highest pose
  double corridor_m = 0.0;             ///< length of corridor reachable without wading
  double covered_share = 0.0;          ///< of it, observed from within 8 m
  double missed_m = 0.0;               ///< of it, farther than 2 m from all observed corridor
  double certainly_missed_m = 0.0;     ///< the same for corridor that an inflated vehicle reaches
  double distance_travelled_m = 0.0;   ///< true
  double simulated_s = 0.0;
  double wall_s = 0.0;
  int scans = 0;
  double rmse_m = 0.0;  ///< in plan, of T_map_body by the last graph, aligned at the start
  std::array<double, 3> rmse_xyz_m{};  ///< the same along the axes of the world
  double plan_of_allowed = 0.0;        ///< root mean square of error over allowed error, see
  double height_of_allowed = 0.0;      ///< TrajectoryScore
  std::size_t local_maps = 0;          ///< see MapConsistency
  std::array<std::size_t, 3> in_interval{};
  std::size_t in_ellipsoid = 0;
  double normalised_error_squared = 0.0;
  double rmse_estimated_m = 0.0;    ///< in plan, of T_map_body as estimated at the time
  double rmse_estimated_z_m = 0.0;  ///< the same in height
  double length_ratio = 0.0;        ///< path length by the last graph over the true one
  int verdicts = 0;                 ///< blocked verdicts on frontiers
  int false_verdicts = 0;       ///< of these, where an inflated vehicle fits beyond the frontier
  int unconfirmed = 0;          ///< frontiers abandoned without an observed obstacle
  int route_home_verdicts = 0;  ///< blocked verdicts on the route home or without a frontier
  bool complete = false;        ///< exploration reported as complete
  int rescans = 0;              ///< repeated scans from the same viewpoint
  int back_offs = 0;
  int guard_stops = 0;
  /// True, of the body to what it must not touch, also below its belly and above it; kClearanceMaxM
  /// if it was never nearer.
  double least_clearance_m = 0.0;
  std::array<std::size_t, kActivities> activity_times{};  ///< by Activity, as in TimeBudget
  std::array<double, kActivities> activity_s{};
  std::array<double, kActivities> activity_m{};
  std::size_t loop_closures = 0;   ///< see LevelConsistency
  std::size_t between_levels = 0;  ///< of these
  double merged_m = 0.0;
  double loop_closure_error_m = 0.0;    ///< largest of a loop closure in the last graph
  std::size_t wrong_loop_closures = 0;  ///< of these, by more than kWrongM

  static constexpr double kWrongM = 0.5;
  static constexpr double kClearanceMaxM = 0.2;
  [[nodiscard]] bool false_complete() const { return complete && missed_m > 2.0; }
};

/// Ground truth of a world for the evaluation of missions. The constructor searches the reachable
/// area.
class MissionTruth {
 public:
  static constexpr double kCoverageRangeM = 8.0;  ///< within which corridor counts as observed
  /// Distances beyond a frontier at which access is checked; a blockage is false if both are
  /// reachable. The frontier is up to a metre before what blocks it, and on a grade that is too
  /// steep a vehicle still gets as far as its front wheels hold the mean below the limit.
  static constexpr std::array<double, 2> kBeyondFrontierM{1.5, 2.5};
  static constexpr double kMarginM = 0.1;  ///< around the inflated vehicle

  /// `vehicle`: that of the mission, which decides what is reachable.
  explicit MissionTruth(const World& world, const Vehicle& vehicle = {});

  /// All fields except `wall_s`.
  [[nodiscard]] MissionScore score(const MissionLog& log) const;

 private:
  void add_coverage(const MissionLog& log, MissionScore& score) const;
  void add_verdicts(const MissionLog& log, MissionScore& score) const;

  WorldTruth truth_;
  Vehicle vehicle_;
  std::unique_ptr<Site> site_;
  std::vector<PlanarMine> mines_;              ///< one for each level
  std::vector<PlanarMine> mines_with_margin_;  ///< the same for the inflated vehicle
};

}  // namespace adit::test
