// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "common/config/bounds.hpp"
#include "common/types/planned_path.hpp"
#include "common/types/terrain_map.hpp"
#include "procs/planning/goals/goal_route.hpp"
#include "procs/planning/lattice/lattice.hpp"

namespace adit {

struct GoalParams {
  double shortfall_factor = 8.0;  ///< a metre short costs this many of even ground; the worst 7
  double lateral_factor = 1.0;    ///< likewise a metre beside the line from the robot
  double tolerance_m = 0.3;       ///< of a pose that is to be reached
  double heading_tolerance_rad = 0.25;
  double along_heading_max_rad = 0.8;  ///< to a corridor, of the end of a path down it, either way
  double min_progress_m = 2.5;  ///< of a path down a corridor; less is none (paper, section 3.3)
  double route_offset_max_m = 1.5;  ///< of the end of a path along a route
  double goal_radius_m = 0.5;       ///< off the end of a route that is to be reached, at most
  double end_clearance_m =
      1.5;  ///< that the end of a path should have to what is lethal, all round
  double end_clearance_factor =
      8.0;  ///< a metre less costs this many of even ground: no pockets beside walls

  template <class V>
  void visit(V& v) {
    v("shortfall_factor", shortfall_factor, within(0.0, 100.0));
    v("lateral_factor", lateral_factor, within(0.0, 100.0));
    v("tolerance_m", tolerance_m, above(0.0));
    v("heading_tolerance_rad", heading_tolerance_rad, above(0.0));
    v("along_heading_max_rad", along_heading_max_rad, above(0.0));
    v("min_progress_m", min_progress_m, at_least(0.0));
    v("route_offset_max_m", route_offset_max_m, above(0.0));
    v("goal_radius_m", goal_radius_m, above(0.0));
    v("end_clearance_m", end_clearance_m, within(0.0, 10.0));
    v("end_clearance_factor", end_clearance_factor, within(0.0, 100.0));
  }
};

/// The array of goals of the paper's section 3.3: what it costs to end in each cell. Down a
/// corridor every cell that is far enough is a goal, the farthest straight down the best; along a
/// route likewise; onto the own track those poses of it are that can be driven on, the farther back
/// the better; otherwise those within reach of a pose are. Where the end of a route is to be
/// reached, what lies round it is, too, with any heading, and the nearer the better.
class GoalField {
 public:
  static constexpr std::int32_t kNoGoal = -1;

  /// All poses in level. `clearance_m`: from the middle of each cell to the nearest that is
  /// lethal [m], or nothing where that is not to count.
  GoalField(const PlanGoal& goal, const Pose2& T_level_goal, const Pose2& T_level_body,
            const TerrainMap& terrain, const GoalParams& params,
            const std::vector<float>& clearance_m = {});

  /// Of ending in a cell, or kNoGoal.
  [[nodiscard]] std::int32_t ending_cost(std::size_t cell) const { return ending_costs_[cell]; }
  [[nodiscard]] std::size_t cells() const { return ending_costs_.size(); }
  /// Whether a search may end in a cell with this heading: nobody gets farther down a corridor by
  /// turning across it. At a place that is to be reached it does not matter.
  [[nodiscard]] bool accepts(std::size_t cell, double heading_rad) const;
  /// From the robot on towards the goal [m]. Far beside a route there is none.
  [[nodiscard]] double progress(const Eigen::Vector2d& p_level) const;
  /// The same of the middle of a cell.
  [[nodiscard]] double progress(std::size_t cell) const { return progress_m_[cell]; }
  /// The least that is a path [m].
  [[nodiscard]] double min_progress() const { return min_progress_m_; }
  /// Whether the way is to go on from the end of a path.
  [[nodiscard]] bool continues_beyond(const Eigen::Vector2d& p_level) const;
  /// In which it goes on at a place, a unit vector.
  [[nodiscard]] Eigen::Vector2d direction(const Eigen::Vector2d& p_level) const;

 private:
  void set_route(const std::vector<Eigen::Vector2d>& points);
  void set_target(double within_m);
  [[nodiscard]] bool has_route() const;
  [[nodiscard]] bool has_continuation() const;
  [[nodiscard]] bool is_in_goal_radius(const Eigen::Vector2d& p_level) const;
  [[nodiscard]] std::int32_t corridor_cost(const Eigen::Vector2d& p_level) const;
  [[nodiscard]] std::int32_t target_cost(const Eigen::Vector2d& p_level) const;
  [[nodiscard]] std::int32_t route_cost(const GoalRoute::Projection& projection) const;
  void add_clearance_cost(const std::vector<float>& clearance_m);
  void add_traversed_path(const std::vector<Pose2>& traversed_path_odom, const TerrainMap& terrain);
  [[nodiscard]] double progress(const GoalRoute::Projection& projection) const;
  void add_cell(const Eigen::Vector2d& p_level);

  PlanGoal::Kind kind_;
  GoalParams params_;
  Pose2 T_level_goal_;
  double goal_radius_m_ =
      0.0;  ///< round the goal, where any heading will do; 0: there is no such place
  Eigen::Vector2d p_level_body_;
  Eigen::Vector2d direction_;  ///< unit vector in level
  double distance_m_;
  double min_progress_m_;
  bool is_last_leg_ = false;  ///< the route ends here: not near its end, but there
  GoalRoute route_;
  std::vector<std::int32_t> ending_costs_;
  std::vector<double> progress_m_;    ///< of each cell
  std::vector<float> headings_rad_;   ///< in which it goes on, of each cell
  std::vector<bool> in_goal_radius_;  ///< whether a cell is where any heading will do
};

}  // namespace adit
