// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "common/pose_graph/map_graph.hpp"
#include "common/types/local_map.hpp"
#include "procs/exploration/exploration.hpp"
#include "tests/support/worlds/planar_mine.hpp"
#include "tests/support/worlds/wall_world.hpp"

namespace adit::test {

/// A robot without physics that goes along routes in a light mine, sees with two level lasers, and
/// makes local maps of what it saw, with a graph that is a little wrong: map is where the robot
/// started, bent smoothly by up to `distortion_m`, and bent anew with each local map.
class ExploringRobot {
 public:
  explicit ExploringRobot(const PlanarMine& mine, double distortion_m = 0.0,
                          std::uint64_t seed = 1);

  /// Along a route in map, this far at most, and round what is in the way, as a planner that sees
  /// the truth for ten metres. How far it got; it stops where there is no way of 2.5 m.
  /// A local map is made of the way.
  double drive(const std::vector<Eigen::Vector2d>& route_map, double distance_m);
  /// Whether the last way ended before something that it cannot pass.
  [[nodiscard]] bool stopped() const { return blocked_; }

  [[nodiscard]] const LocalMap& last_map() const { return maps_.back(); }
  [[nodiscard]] MapGraph graph() const;
  [[nodiscard]] Pose2 T_map_body() const;
  [[nodiscard]] const Pose2& T_world_body() const { return T_world_body_; }
  [[nodiscard]] double distance_travelled_m() const { return distance_travelled_m_; }
  [[nodiscard]] std::int64_t utime() const;
  /// Share of the corridor that was seen from within kCoverageRangeM [0 to 1].
  [[nodiscard]] double covered_share() const;
  [[nodiscard]] Eigen::Vector2d to_map(const Eigen::Vector2d& p_world) const;

  /// Of the corridor, what is farther than kMissedM from all that was seen [m].
  [[nodiscard]] double missed_m() const;
  /// Where it has been, p_world.
  [[nodiscard]] const std::vector<Eigen::Vector2d>& traversed_path() const {
    return traversed_path_;
  }

  static constexpr double kMissedM = 2.0;
  static constexpr double kCoverageRangeM = 8.0;

 private:
  [[nodiscard]] Pose2 distorted(const Pose2& T_world) const;
  void start_map();
  void scan();
  void update_coverage();
  bool drive_to(const Eigen::Vector2d& target, double distance_m, double& driven_m);

  const PlanarMine* mine_;
  double distortion_m_;
  LevelLaser laser_;
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

/// How an exploration went.
struct ExplorationRun {
  std::vector<double> covered_share;  ///< at 25, 50, 75 and 100 % of the budget
  double missed_m = 0.0;              ///< of corridor that was not seen, nor anything near it
  std::vector<Eigen::Vector2d> path_map;
  double distance_travelled_m = 0.0;
  double distance_from_start_m = 0.0;  ///< from the start, at the end
  bool returned = false;               ///< within half a metre, within the budget
  bool complete = false;               ///< what the exploration says of it
  int frontiers = 0;
  int blocked = 0;          ///< stubs that the planner said to be blocked
  int falsely_blocked = 0;  ///< of them those that could be reached
  int decisions = 0;
  int turns = 0;  ///< times that the target changed to another that was open before
  double longest_decision_s = 0.0;
};

/// Until the robot is at home to stay, or the budget is spent, or nothing more can be done.
ExplorationRun run_exploration(const PlanarMine& mine, Exploration& exploration, double budget_m,
                               double distortion_m = 0.0, std::uint64_t seed = 1);

}  // namespace adit::test
