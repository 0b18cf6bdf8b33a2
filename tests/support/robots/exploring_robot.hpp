// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "common/pose_graph/map_graph.hpp"
#include "common/types/local_map.hpp"
#include "procs/exploration/exploration.hpp"
#include "tests/support/worlds/planar_mine.hpp"
#include "tests/support/worlds/wall_world.hpp"

namespace adit::test {

/// A kinematic robot that follows routes in a PlanarMine, scans with two level lasers and makes
/// local maps. The origin of map is the start pose. The pose graph is distorted smoothly with an
/// amplitude of `distortion_m`; the distortion changes with each local map.
class ExploringRobot {
 public:
  explicit ExploringRobot(const PlanarMine& mine, double distortion_m = 0.0,
                          std::uint64_t seed = 1);

  /// Follows a route in map for at most `distance_m` and makes one local map. Detours around
  /// obstacles use the ground truth within 10 m; the robot stops if no path of 2.5 m exists.
  /// Returns the distance travelled [m].
  double drive(const std::vector<Eigen::Vector2d>& route_map, double distance_m);
  /// Whether the last drive ended at an obstacle without a detour.
  [[nodiscard]] bool stopped() const { return blocked_; }

  [[nodiscard]] const LocalMap& last_map() const { return maps_.back(); }
  [[nodiscard]] MapGraph graph() const;
  [[nodiscard]] Pose2 T_map_body() const;
  [[nodiscard]] const Pose2& T_world_body() const { return T_world_body_; }
  [[nodiscard]] double distance_travelled_m() const { return distance_travelled_m_; }
  [[nodiscard]] std::int64_t utime() const;
  /// Share of the corridor that was observed from within kCoverageRangeM [0 to 1].
  [[nodiscard]] double covered_share() const;
  [[nodiscard]] Eigen::Vector2d to_map(const Eigen::Vector2d& p_world) const;

  /// Length of corridor farther than kMissedM from all observed corridor [m].
  [[nodiscard]] double missed_m() const;
  /// Positions of the scans, p_world.
  [[nodiscard]] const std::vector<Eigen::Vector2d>& traversed_path() const {
    return traversed_path_;
  }

  static constexpr double kMissedM = 2.0;
  static constexpr double kCoverageRangeM = 8.0;

 private:
  [[nodiscard]] Pose2 distorted(const Pose2& T_world) const;
  void start_map();
  void scan();
  LaserScan measure(const Pose2& T_world_laser);
  void update_coverage();
  bool drive_to(const Eigen::Vector2d& target, double distance_m, double& driven_m);

  const PlanarMine* mine_;
  double distortion_m_;
  std::mt19937_64 random_;
  std::normal_distribution<double> noise_m_;
  Pose2 T_world_body_;
  Pose2 T_world_local_;
  std::vector<Pose2> T_world_locals_;
  std::vector<LocalMap> maps_;
  LocalMap map_;
  double distance_travelled_m_ = 0.0;
  double since_scan_m_ = 0.0;
  bool blocked_ = false;
  std::vector<bool> covered_;
  std::size_t n_covered_ = 0;
  std::vector<Eigen::Vector2d> traversed_path_;
};

/// The result of an exploration.
struct ExplorationRun {
  std::vector<double> covered_share;  ///< at 25, 50, 75 and 100 % of the budget
  double missed_m = 0.0;              ///< ExploringRobot::missed_m at the end
  std::vector<Eigen::Vector2d> path_map;
  double distance_travelled_m = 0.0;
  double distance_from_start_m = 0.0;  ///< at the end
  bool returned = false;               ///< to within half a metre of the start, within the budget
  bool complete = false;               ///< as reported by the exploration
  int frontiers = 0;
  int blocked = 0;          ///< blocked verdicts of the planner
  int falsely_blocked = 0;  ///< blocked frontiers that the vehicle can enter
  int decisions = 0;
  int turns = 0;  ///< changes of target while the previous target was still open
  double longest_decision_s = 0.0;
};

/// Explores until the exploration is done or stays, the budget is spent, or the robot makes no
/// progress. `budget_m` limits the distance travelled.
ExplorationRun run_exploration(const PlanarMine& mine, Exploration& exploration, double budget_m,
                               double distortion_m = 0.0, std::uint64_t seed = 1);

}  // namespace adit::test
