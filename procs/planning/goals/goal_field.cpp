// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/goals/goal_field.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "procs/planning/goals/retrace.hpp"

namespace adit {
namespace {

constexpr double kApproachMinM = 0.1;  // a path to a place must come nearer by as much
constexpr double kDirectionM = 1.0;    // of a route, that gives the direction at a point

Eigen::Vector2d unit_vector(double angle) { return {std::cos(angle), std::sin(angle)}; }

}  // namespace

GoalField::GoalField(const PlanGoal& goal, const Pose2& T_level_goal, const Pose2& T_level_body,
                     const TerrainMap& terrain, const GoalParams& params,
                     const Grid2<float>& clearance_m)
    : kind_(goal.kind),
      params_(params),
      T_level_goal_(T_level_goal),
      p_level_body_(T_level_body.translation()),
      direction_(unit_vector(T_level_goal.theta)),
      distance_m_(goal.distance_m),
      min_progress_m_(std::min(params.min_progress_m, goal.distance_m)) {
  if (kind_ == PlanGoal::Kind::kToPose) set_target(params.tolerance_m);
  if (kind_ == PlanGoal::Kind::kRoute || kind_ == PlanGoal::Kind::kRouteTo ||
      kind_ == PlanGoal::Kind::kRejoin) {
    const Pose2 T_level_odom = terrain.T_odom_level.inverse();
    std::vector<Eigen::Vector2d> points;
    for (const Eigen::Vector2d& p : goal.route_odom) points.emplace_back(T_level_odom * p);
    set_route(points);
  }
  ending_costs_.reserve(terrain.cells.size());
  headings_rad_.reserve(terrain.cells.size());
  in_goal_radius_.reserve(terrain.cells.size());
  for (int row = 0; row < terrain.cells.rows(); ++row) {
    for (int column = 0; column < terrain.cells.columns(); ++column)
      add_cell(terrain.centre(column, row));
  }
  if (has_continuation()) add_clearance_cost(clearance_m);
  if (kind_ == PlanGoal::Kind::kRejoin) add_traversed_path(goal.traversed_path_odom, terrain);
}

/// The rest of the traversed path from a pose on costs as even ground: no path beside it is
/// cheaper, unless it is a short cut. Of two passes over a cell the later pose counts, as it is
/// closer to the end.
void GoalField::add_traversed_path(const std::vector<Pose2>& traversed_path_odom,
                                   const TerrainMap& terrain) {
  const Pose2 T_level_odom = terrain.T_odom_level.inverse();
  const int reach = static_cast<int>(std::ceil(kOnPathM / terrain.cell_m));
  double remaining_m = 0.0;
  for (std::size_t i = traversed_path_odom.size(); i-- > 0;) {
    const Pose2 T_level_traversed = T_level_odom * traversed_path_odom[i];
    const Eigen::Vector2d p = T_level_traversed.translation();
    const Eigen::Vector2i at = terrain.cell_at(p);
    for (int row = at.y() - reach; row <= at.y() + reach; ++row) {
      for (int column = at.x() - reach; column <= at.x() + reach; ++column) {
        if (!terrain.cells.contains({column, row})) continue;
        if ((terrain.centre(column, row) - p).norm() > kOnPathM) continue;
        const std::size_t cell = terrain.cells.index({column, row});
        if (ending_costs_[cell] != kNoGoal) continue;
        ending_costs_[cell] = even_ground_cost(remaining_m);
        headings_rad_[cell] = static_cast<float>(T_level_traversed.theta);
      }
    }
    if (i > 0) {
      remaining_m +=
          (traversed_path_odom[i].translation() - traversed_path_odom[i - 1].translation()).norm();
    }
  }
}

void GoalField::set_route(const std::vector<Eigen::Vector2d>& points) {
  route_ = GoalRoute(points);
  if (kind_ == PlanGoal::Kind::kRejoin) return;
  distance_m_ = route_.length_m();
  min_progress_m_ = std::min(params_.min_progress_m, distance_m_ - params_.tolerance_m);
  is_last_leg_ = min_progress_m_ < params_.min_progress_m;
  if (kind_ != PlanGoal::Kind::kRouteTo || points.empty()) return;
  T_level_goal_ = {points.back().x(), points.back().y(), 0.0};
  goal_radius_m_ =
      std::min(params_.goal_radius_m, (points.back() - p_level_body_).norm() - kApproachMinM);
  if (is_last_leg_) set_target(goal_radius_m_);
}

void GoalField::set_target(double within_m) {
  const Eigen::Vector2d offset = T_level_goal_.translation() - p_level_body_;
  distance_m_ = offset.norm();
  min_progress_m_ = distance_m_ - within_m;
  if (distance_m_ > 0.0) direction_ = offset / distance_m_;
}

/// The last leg to a place does not follow the route: it may need changes of direction.
bool GoalField::has_route() const {
  const bool always = kind_ == PlanGoal::Kind::kRoute || kind_ == PlanGoal::Kind::kRejoin;
  return always || (kind_ == PlanGoal::Kind::kRouteTo && !is_last_leg_);
}

bool GoalField::has_continuation() const {
  return kind_ != PlanGoal::Kind::kToPose && kind_ != PlanGoal::Kind::kRejoin && !is_last_leg_;
}

bool GoalField::is_in_goal_radius(const Eigen::Vector2d& p_level) const {
  return (p_level - T_level_goal_.translation()).norm() <= goal_radius_m_ && goal_radius_m_ > 0.0;
}

bool GoalField::continues_beyond(const Eigen::Vector2d& p_level) const {
  return has_continuation() && !is_in_goal_radius(p_level);
}

/// With little clearance at the end, the robot may find no continuation, or only after backing up.
void GoalField::add_clearance_cost(const Grid2<float>& clearance_m) {
  for (std::size_t i = 0; i < clearance_m.size(); ++i) {
    if (ending_costs_[i] == kNoGoal || in_goal_radius_[i]) continue;
    const double missing_m =
        std::max(0.0, params_.end_clearance_m - static_cast<double>(clearance_m[i]));
    ending_costs_[i] += even_ground_cost(params_.end_clearance_factor * missing_m);
  }
}

void GoalField::add_cell(const Eigen::Vector2d& p_level) {
  in_goal_radius_.push_back(is_in_goal_radius(p_level));
  if (!has_route()) {
    progress_m_.push_back(progress(p_level));
    ending_costs_.push_back(kind_ == PlanGoal::Kind::kAlong ? corridor_cost(p_level)
                                                            : target_cost(p_level));
    headings_rad_.push_back(static_cast<float>(T_level_goal_.theta));
  } else if (route_.empty() || kind_ == PlanGoal::Kind::kRejoin) {
    ending_costs_.push_back(kNoGoal);
    progress_m_.push_back(0.0);
    headings_rad_.push_back(0.0F);
  } else {
    const GoalRoute::Projection projection = route_.nearest(p_level);
    ending_costs_.push_back(in_goal_radius_.back() ? target_cost(p_level) : route_cost(projection));
    progress_m_.push_back(progress(projection));
    headings_rad_.push_back(
        static_cast<float>(std::atan2(projection.tangent.y(), projection.tangent.x())));
  }
}

std::int32_t GoalField::route_cost(const GoalRoute::Projection& projection) const {
  const double lateral_max_m = is_last_leg_ ? params_.tolerance_m : params_.route_offset_max_m;
  if (projection.s_m < min_progress_m_ || projection.lateral_m > lateral_max_m) return kNoGoal;
  const double shortfall_m = std::abs(distance_m_ - projection.s_m);
  return even_ground_cost(params_.shortfall_factor * shortfall_m +
                          params_.lateral_factor * projection.lateral_m);
}

std::int32_t GoalField::corridor_cost(const Eigen::Vector2d& p_level) const {
  const Eigen::Vector2d offset = p_level - p_level_body_;
  const double progress = offset.dot(direction_);
  if (progress < min_progress_m_) return kNoGoal;
  const double lateral = std::abs(direction_.x() * offset.y() - direction_.y() * offset.x());
  return even_ground_cost(params_.shortfall_factor * std::max(0.0, distance_m_ - progress) +
                          params_.lateral_factor * lateral);
}

std::int32_t GoalField::target_cost(const Eigen::Vector2d& p_level) const {
  const double distance_m = (p_level - T_level_goal_.translation()).norm();
  if (is_in_goal_radius(p_level)) return even_ground_cost(params_.shortfall_factor * distance_m);
  if (kind_ != PlanGoal::Kind::kToPose || distance_m > params_.tolerance_m) return kNoGoal;
  return even_ground_cost(distance_m);
}

bool GoalField::accepts(std::size_t cell, double heading_rad) const {
  if (in_goal_radius_[cell] || (kind_ == PlanGoal::Kind::kRouteTo && !has_route())) return true;
  const double error_rad =
      std::abs(angle_diff(heading_rad, static_cast<double>(headings_rad_[cell])));
  if (kind_ == PlanGoal::Kind::kToPose) return error_rad <= params_.heading_tolerance_rad;
  if (kind_ == PlanGoal::Kind::kRejoin) return error_rad <= kOnPathRad;
  return std::min(error_rad, std::numbers::pi - error_rad) <= params_.along_heading_max_rad;
}

double GoalField::progress(const Eigen::Vector2d& p_level) const {
  if (kind_ == PlanGoal::Kind::kAlong) return (p_level - p_level_body_).dot(direction_);
  if (!has_route()) {
    return distance_m_ - (p_level - T_level_goal_.translation()).norm();
  }
  if (route_.empty()) return 0.0;
  return progress(route_.nearest(p_level));
}

double GoalField::progress(const GoalRoute::Projection& projection) const {
  return projection.lateral_m > params_.route_offset_max_m ? 0.0
                                                           : std::min(projection.s_m, distance_m_);
}

Eigen::Vector2d GoalField::direction(const Eigen::Vector2d& p_level) const {
  if (!has_route() || route_.empty()) return direction_;
  const double s_m = route_.nearest(p_level).s_m;
  return (route_.point(s_m + kDirectionM) - route_.point(s_m)).normalized();
}

}  // namespace adit
