// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Where the mission looks, and with which laser.
#include <cmath>
#include <numbers>
#include <utility>

#include "procs/mission/mission.hpp"

namespace adit {
namespace {

constexpr double kFacingM = 2.5;         // of the route, that says in which direction it leads
constexpr double kFacingSlackRad = 0.3;  // before the other laser leads
constexpr double kSightM = 10.0;         // without a map
constexpr double kNeverLeftM = 0.3;

std::vector<Eigen::Vector2d> beginning_of(const std::vector<Eigen::Vector2d>& line,
                                          double length_m) {
  std::vector<Eigen::Vector2d> beginning{line.front()};
  double left_m = length_m;
  for (std::size_t i = 1; i < line.size() && left_m > 0.0; ++i) {
    const Eigen::Vector2d leg = line[i] - line[i - 1];
    const double leg_m = leg.norm();
    beginning.push_back(leg_m > left_m ? line[i - 1] + left_m / leg_m * leg : line[i]);
    left_m -= leg_m;
  }
  return beginning;
}

}  // namespace

/// Where the body looks, or, if that was in vain, back where it came from.
void Mission::go_by_sight(const std::string& reason) {
  if (!way_.T_odom_body()) return;
  phase_.stub = -1;
  by_sight_ = true;
  p_odom_home_.reset();
  attempt_.aim_at(-1, phase_.homeward);
  const bool reverse = lost_tries_ % 2 == 1;
  const double reach_m = reverse ? -kSightM : kSightM;
  look_along(
      {way_.T_odom_body()->translation(), *way_.T_odom_body() * Eigen::Vector2d(reach_m, 0.0)},
      reason);
}

void Mission::look_along(std::vector<Eigen::Vector2d> route_odom, const std::string& reason) {
  if (route_odom.size() < 2) {
    lost_try("no route leads there");
    return;
  }
  route_odom_ = std::move(route_odom);
  goal_kind_ = PlanGoal::Kind::kRoute;
  tries_ = 0;
  look(facing(route_odom_), reason);
}

void Mission::look(LaserId laser, const std::string& reason) {
  phase_.laser = laser;
  ++phase_.goal_id;
  enter(Phase::kScan, reason);
}

LaserId Mission::facing(const std::vector<Eigen::Vector2d>& route_odom) const {
  const Pose2& T_odom_body = *way_.T_odom_body();
  Eigen::Vector2d ahead = route_odom.back();
  for (const Eigen::Vector2d& p : route_odom) {
    if ((p - T_odom_body.translation()).norm() < kFacingM) continue;
    ahead = p;
    break;
  }
  const Eigen::Vector2d p_body = T_odom_body.inverse() * ahead;
  const double off = std::abs(std::atan2(p_body.y(), p_body.x()));
  const double slack = phase_.laser == LaserId::kFront ? kFacingSlackRad : -kFacingSlackRad;
  return off < std::numbers::pi / 2.0 + slack ? LaserId::kFront : LaserId::kRear;
}

PlanGoal Mission::goal() const {
  // What is to be seen from there does not ask for a heading.
  const bool to_place = (p_odom_home_ || nearer_m_ > 0.0) && !backing_off_;
  const PlanGoal::Kind kind = to_place ? PlanGoal::Kind::kRouteTo : goal_kind_;
  const double distance_m = backing_off_ ? goal_distance_m_ : kSightM;
  const bool backwards = backing_off_ && !route_back_odom_.empty();
  const auto& route_odom = backwards ? route_back_odom_ : route_odom_;
  PlanGoal goal{utime_, phase_.goal_id, kind, {}, distance_m, route_odom, {}};
  if (nearer_m_ > 0.0) goal.route_odom = beginning_of(route_odom_, nearer_m_);
  if (backing_off_) goal.track_odom = track_odom_;
  const Eigen::Vector2d p_odom_end =
      backing_off_ ? track_odom_.back().translation() : goal.route_odom.back();
  goal.T_odom_goal = {p_odom_end.x(), p_odom_end.y(), 0.0};
  return goal;
}

void Mission::lost_try(const std::string& reason) {
  ++lost_tries_;
  if (lost_tries_ > params_.lost_tries_max) {
    const bool never_left = way_.travelled_m() < kNeverLeftM;
    end(never_left ? MissionOutcome::kHome : MissionOutcome::kStranded,
        (never_left ? "there is no way into the mine: " : "no way on was found: ") + reason);
  } else if (phase_.homeward && has_map_ && track_that_leads_there_m() > 0.0) {
    rejoin(track_that_leads_there_m(), "exploration knows no way (" + reason + ")");
  } else {
    go_by_sight("exploration knows no way (" + reason + "): straight on");
  }
}

}  // namespace adit
