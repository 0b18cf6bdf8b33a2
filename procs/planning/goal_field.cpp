// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/goal_field.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "procs/planning/retrace.hpp"

namespace adit {
namespace {

constexpr double kNearerM = 0.1;  // to a place; a path that gets no nearer is none

Eigen::Vector2d ahead(double angle) { return {std::cos(angle), std::sin(angle)}; }

std::int32_t cost_of(double metres) {
  return static_cast<std::int32_t>(std::lround(kCostPerM * metres));
}

}  // namespace

GoalField::GoalField(const PlanGoal& goal, const Pose2& T_level_goal, const Pose2& T_level_body,
                     const TerrainMap& terrain, const GoalParams& params,
                     const std::vector<float>& room_m)
    : kind_(goal.kind),
      params_(params),
      T_level_goal_(T_level_goal),
      p_level_body_(T_level_body.translation()),
      direction_(ahead(T_level_goal.theta)),
      distance_m_(goal.distance_m),
      least_progress_m_(std::min(params.min_progress_m, goal.distance_m)) {
  if (kind_ == PlanGoal::Kind::kTo) approach(params.tolerance_m);
  if (kind_ == PlanGoal::Kind::kRoute || kind_ == PlanGoal::Kind::kRouteTo ||
      kind_ == PlanGoal::Kind::kRejoin) {
    const Pose2 T_level_odom = terrain.T_odom_level.inverse();
    std::vector<Eigen::Vector2d> points;
    for (const Eigen::Vector2d& p : goal.route_odom) points.emplace_back(T_level_odom * p);
    follow(points);
  }
  ending_costs_.reserve(terrain.cells.size());
  headings_rad_.reserve(terrain.cells.size());
  at_place_.reserve(terrain.cells.size());
  for (int row = 0; row < terrain.rows; ++row) {
    for (int column = 0; column < terrain.columns; ++column) add_cell(terrain.centre(column, row));
  }
  if (has_way_on()) add_room(room_m);
  if (kind_ == PlanGoal::Kind::kRejoin) add_track(goal.track_odom, terrain);
}

/// What is left of the track from a pose on costs as even ground does: no way that is off it is
/// cheaper, unless it cuts off some of it. Where it was twice, the later pose leads back sooner.
void GoalField::add_track(const std::vector<Pose2>& track_odom, const TerrainMap& terrain) {
  const Pose2 T_level_odom = terrain.T_odom_level.inverse();
  const int reach = static_cast<int>(std::ceil(kOnTrackM / terrain.cell_m));
  double left_m = 0.0;
  for (std::size_t i = track_odom.size(); i-- > 0;) {
    const Pose2 T_level_track = T_level_odom * track_odom[i];
    const Eigen::Vector2d p = T_level_track.translation();
    const Eigen::Vector2d cells = (p - terrain.p_level_corner) / terrain.cell_m;
    const int column = static_cast<int>(std::floor(cells.x()));
    const int row = static_cast<int>(std::floor(cells.y()));
    for (int r = row - reach; r <= row + reach; ++r) {
      for (int c = column - reach; c <= column + reach; ++c) {
        if (!terrain.contains(c, r) || (terrain.centre(c, r) - p).norm() > kOnTrackM) continue;
        const auto cell = static_cast<std::size_t>(r) * static_cast<std::size_t>(terrain.columns) +
                          static_cast<std::size_t>(c);
        if (ending_costs_[cell] != kNoGoal) continue;
        ending_costs_[cell] = cost_of(left_m);
        headings_rad_[cell] = static_cast<float>(T_level_track.theta);
      }
    }
    if (i > 0) left_m += (track_odom[i].translation() - track_odom[i - 1].translation()).norm();
  }
}

void GoalField::follow(const std::vector<Eigen::Vector2d>& points) {
  route_ = GoalRoute(points);
  if (kind_ == PlanGoal::Kind::kRejoin) return;
  distance_m_ = route_.length_m();
  least_progress_m_ = std::min(params_.min_progress_m, distance_m_ - params_.tolerance_m);
  is_last_leg_ = least_progress_m_ < params_.min_progress_m;
  if (kind_ != PlanGoal::Kind::kRouteTo || points.empty()) return;
  T_level_goal_ = {points.back().x(), points.back().y(), 0.0};
  place_m_ = std::min(params_.place_m, (points.back() - p_level_body_).norm() - kNearerM);
  if (is_last_leg_) approach(place_m_);
}

void GoalField::approach(double within_m) {
  const Eigen::Vector2d way = T_level_goal_.translation() - p_level_body_;
  distance_m_ = way.norm();
  least_progress_m_ = distance_m_ - within_m;
  if (distance_m_ > 0.0) direction_ = way / distance_m_;
}

/// The last leg to a place is not along anything: it may take turning to and fro.
bool GoalField::has_route() const {
  const bool along_it = kind_ == PlanGoal::Kind::kRoute || kind_ == PlanGoal::Kind::kRejoin;
  return along_it || (kind_ == PlanGoal::Kind::kRouteTo && !is_last_leg_);
}

bool GoalField::has_way_on() const {
  return kind_ != PlanGoal::Kind::kTo && kind_ != PlanGoal::Kind::kRejoin && !is_last_leg_;
}

bool GoalField::is_at_place(const Eigen::Vector2d& p_level) const {
  return (p_level - T_level_goal_.translation()).norm() <= place_m_ && place_m_ > 0.0;
}

bool GoalField::leads_on(const Eigen::Vector2d& p_level) const {
  return has_way_on() && !is_at_place(p_level);
}

/// Where there is little room, the way on may be shut, or only be found after going back.
void GoalField::add_room(const std::vector<float>& room_m) {
  for (std::size_t i = 0; i < room_m.size(); ++i) {
    if (ending_costs_[i] == kNoGoal || at_place_[i]) continue;
    const double missing_m = std::max(0.0, params_.room_m - static_cast<double>(room_m[i]));
    ending_costs_[i] += cost_of(params_.room_factor * missing_m);
  }
}

void GoalField::add_cell(const Eigen::Vector2d& p_level) {
  at_place_.push_back(is_at_place(p_level));
  if (!has_route()) {
    progress_m_.push_back(progress(p_level));
    ending_costs_.push_back(kind_ == PlanGoal::Kind::kAlong ? along(p_level) : to(p_level));
    headings_rad_.push_back(static_cast<float>(T_level_goal_.theta));
  } else if (route_.empty() || kind_ == PlanGoal::Kind::kRejoin) {
    ending_costs_.push_back(kNoGoal);
    progress_m_.push_back(0.0);
    headings_rad_.push_back(0.0F);
  } else {
    const GoalRoute::Place place = route_.nearest(p_level);
    ending_costs_.push_back(at_place_.back() ? to(p_level) : on_route(place));
    progress_m_.push_back(progress(place));
    headings_rad_.push_back(static_cast<float>(std::atan2(place.tangent.y(), place.tangent.x())));
  }
}

std::int32_t GoalField::on_route(const GoalRoute::Place& place) const {
  const double lateral_max_m = is_last_leg_ ? params_.tolerance_m : params_.beside_route_max_m;
  if (place.s_m < least_progress_m_ || place.lateral_m > lateral_max_m) return kNoGoal;
  const double shortfall_m = std::abs(distance_m_ - place.s_m);
  return cost_of(params_.shortfall_factor * shortfall_m + params_.lateral_factor * place.lateral_m);
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
  if (is_at_place(p_level)) return cost_of(params_.shortfall_factor * off);
  return kind_ != PlanGoal::Kind::kTo || off > params_.tolerance_m ? kNoGoal : cost_of(off);
}

bool GoalField::accepts(std::size_t cell, double heading_rad) const {
  if (at_place_[cell] || (kind_ == PlanGoal::Kind::kRouteTo && !has_route())) return true;
  const double off = std::abs(angle_diff(heading_rad, static_cast<double>(headings_rad_[cell])));
  if (kind_ == PlanGoal::Kind::kTo) return off <= params_.heading_tolerance_rad;
  if (kind_ == PlanGoal::Kind::kRejoin) return off <= kOnTrackRad;
  return std::min(off, std::numbers::pi - off) <= params_.along_heading_max_rad;
}

double GoalField::progress(const Eigen::Vector2d& p_level) const {
  if (kind_ == PlanGoal::Kind::kAlong) return (p_level - p_level_body_).dot(direction_);
  if (!has_route()) {
    return distance_m_ - (p_level - T_level_goal_.translation()).norm();
  }
  if (route_.empty()) return 0.0;
  return progress(route_.nearest(p_level));
}

double GoalField::progress(const GoalRoute::Place& place) const {
  return place.lateral_m > params_.beside_route_max_m ? 0.0 : std::min(place.s_m, distance_m_);
}

Eigen::Vector2d GoalField::direction(const Eigen::Vector2d& p_level) const {
  return has_route() && !route_.empty() ? route_.nearest(p_level).tangent : direction_;
}

}  // namespace adit
