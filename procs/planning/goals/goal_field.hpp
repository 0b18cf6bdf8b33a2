// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "common/config/bounds.hpp"
#include "common/grid/grid2.hpp"
#include "common/types/planned_path.hpp"
#include "common/types/terrain_map.hpp"
#include "procs/planning/goals/goal_route.hpp"
#include "procs/planning/path_cost.hpp"

namespace adit {

/// Cost factors are in metres of even ground for each metre (path_cost.hpp).
struct GoalParams {
  double shortfall_factor = 8.0;  ///< short of the goal; the roughest ground costs 7
  double lateral_factor = 1.0;    ///< beside the line or route
  double tolerance_m = 0.3;       ///< of a goal pose
  double heading_tolerance_rad = 0.25;
  double along_heading_max_rad = 0.8;  ///< of the end to the corridor, in either direction
  double min_progress_m = 2.5;         ///< of a path down a corridor (section 3.3 of the paper)
  double route_offset_max_m = 1.5;     ///< of the end of a path to its route
  double goal_radius_m = 0.5;          ///< around the end of a route that must be reached
  double end_clearance_m = 1.5;        ///< desired distance of the end to lethal ground
  double end_clearance_factor = 8.0;   ///< below that distance: keeps ends out of wall pockets

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

/// The array of goals of section 3.3 of the paper: the cost of ending in each cell, by the kind of
/// the goal (PlanGoal::Kind):
/// - kAlong: all cells with the minimum progress; the farthest straight ahead is the best;
/// - kRoute: the same along a route;
/// - kRouteTo: the same, and with any heading the cells around its end; the nearest is the best;
/// - kRejoin: the poses of the traversed path; those farthest back are the best;
/// - kToPose: the cells and headings within the tolerances of a pose.
class GoalField : public GoalArray {
 public:
  /// Poses are in level. `clearance_m` is the distance of each cell to lethal ground [m]; empty
  /// leaves out the term of the clearance.
  GoalField(const PlanGoal& goal, const Pose2& T_level_goal, const Pose2& T_level_body,
            const TerrainMap& terrain, const GoalParams& params,
            const Grid2<float>& clearance_m = {});

  [[nodiscard]] std::int32_t ending_cost(std::size_t cell) const override {
    return ending_costs_[cell];
  }
  /// A path may not end across a corridor. Within the goal radius any heading is accepted.
  [[nodiscard]] bool accepts(std::size_t cell, double heading_rad) const override;
  /// Progress of a point towards the goal [m]; 0 far beside a route.
  [[nodiscard]] double progress(const Eigen::Vector2d& p_level) const;
  /// Progress of the centre of a cell [m].
  [[nodiscard]] double progress(std::size_t cell) const { return progress_m_[cell]; }
  /// The minimum progress of a path [m].
  [[nodiscard]] double min_progress() const { return min_progress_m_; }
  /// Whether the robot continues towards the goal after a path that ends here.
  [[nodiscard]] bool continues_beyond(const Eigen::Vector2d& p_level) const;
  /// Direction towards the goal at a point, a unit vector: along a route that of its next metre, as
  /// the first segment of a route may be short and oblique.
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
  void add_clearance_cost(const Grid2<float>& clearance_m);
  void add_traversed_path(const std::vector<Pose2>& traversed_path_odom, const TerrainMap& terrain);
  [[nodiscard]] double progress(const GoalRoute::Projection& projection) const;
  void add_cell(const Eigen::Vector2d& p_level);

  PlanGoal::Kind kind_;
  GoalParams params_;
  Pose2 T_level_goal_;
  double goal_radius_m_ = 0.0;  ///< around the goal, where any heading is accepted; 0: none
  Eigen::Vector2d p_level_body_;
  Eigen::Vector2d direction_;  ///< unit vector in level
  double distance_m_;
  double min_progress_m_;
  bool is_last_leg_ = false;  ///< the end of the route is closer than the minimum progress
  GoalRoute route_;
  // One value for each cell of the terrain map.
  std::vector<std::int32_t> ending_costs_;
  std::vector<double> progress_m_;
  std::vector<float> headings_rad_;  ///< direction towards the goal
  std::vector<bool> in_goal_radius_;
};

}  // namespace adit
