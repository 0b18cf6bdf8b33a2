// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/goal_field.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace adit {
namespace {

Eigen::Vector2d ahead(double angle) { return {std::cos(angle), std::sin(angle)}; }

std::int32_t cost_of(double metres) {
  return static_cast<std::int32_t>(std::lround(kCostPerM * metres));
}

}  // namespace

GoalField::GoalField(const PlanGoal& goal, const Pose2& T_level_goal, const Pose2& T_level_body,
                     const TerrainMap& terrain, const GoalParams& params)
    : kind_(goal.kind),
      params_(params),
      T_level_goal_(T_level_goal),
      p_level_body_(T_level_body.translation()),
      direction_(ahead(T_level_goal.theta)),
      distance_m_(goal.distance_m),
      least_progress_m_(std::min(params.min_progress_m, goal.distance_m)) {
  if (kind_ == PlanGoal::Kind::kTo) {
    const Eigen::Vector2d way = T_level_goal.translation() - p_level_body_;
    distance_m_ = way.norm();
    least_progress_m_ = distance_m_ - params.tolerance_m;
    if (distance_m_ > 0.0) direction_ = way / distance_m_;
  }
  ending_costs_.reserve(terrain.cells.size());
  for (int row = 0; row < terrain.rows; ++row) {
    for (int column = 0; column < terrain.columns; ++column) {
      const Eigen::Vector2d p = terrain.centre(column, row);
      ending_costs_.push_back(kind_ == PlanGoal::Kind::kAlong ? along(p) : to(p));
    }
  }
}

std::int32_t GoalField::along(const Eigen::Vector2d& p_level) const {
  const Eigen::Vector2d way = p_level - p_level_body_;
  const double progress = way.dot(direction_);
  if (progress < least_progress_m_) return kNoGoal;
  const double lateral = std::abs(direction_.x() * way.y() - direction_.y() * way.x());
  return cost_of(params_.shortfall_factor * std::max(0.0, distance_m_ - progress) +
                 params_.lateral_factor * lateral);
}

std::int32_t GoalField::to(const Eigen::Vector2d& p_level) const {
  const double off = (p_level - T_level_goal_.translation()).norm();
  return off > params_.tolerance_m ? kNoGoal : cost_of(off);
}

bool GoalField::accepts(double heading_rad) const {
  const double off = std::abs(angle_diff(heading_rad, T_level_goal_.theta));
  if (kind_ == PlanGoal::Kind::kTo) return off <= params_.heading_tolerance_rad;
  return std::min(off, std::numbers::pi - off) <= params_.along_heading_max_rad;
}

double GoalField::progress(const Eigen::Vector2d& p_level) const {
  if (kind_ == PlanGoal::Kind::kAlong) return (p_level - p_level_body_).dot(direction_);
  return distance_m_ - (p_level - T_level_goal_.translation()).norm();
}

}  // namespace adit
