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
constexpr double kScanReachM = 10.0;     // without a map
constexpr double kStartRadiusM = 0.3;

std::vector<Eigen::Vector2d> first_part_of(const std::vector<Eigen::Vector2d>& line,
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
void Mission::scan_straight_ahead(const std::string& reason) {
  if (!traversed_path_.T_odom_body()) return;
  phase_.frontier = -1;
  without_target_ = true;
  p_odom_home_.reset();
  retry_policy_.set_target(-1, phase_.returning_home);
  const bool reverse = failed_tries_ % 2 == 1;
  const double reach_m = reverse ? -kScanReachM : kScanReachM;
  scan_along({traversed_path_.T_odom_body()->translation(),
              *traversed_path_.T_odom_body() * Eigen::Vector2d(reach_m, 0.0)},
             reason);
}

void Mission::scan_along(std::vector<Eigen::Vector2d> route_odom, const std::string& reason) {
  if (route_odom.size() < 2) {
    note_failed_try("no route leads there");
    return;
  }
  route_odom_ = std::move(route_odom);
  goal_kind_ = PlanGoal::Kind::kRoute;
  scan_tries_ = 0;
  request_scan(facing(route_odom_), reason);
}

void Mission::request_scan(LaserId laser, const std::string& reason) {
  phase_.laser = laser;
  ++phase_.goal_id;
  enter(Phase::kScan, reason);
}

LaserId Mission::facing(const std::vector<Eigen::Vector2d>& route_odom) const {
  const Pose2& T_odom_body = *traversed_path_.T_odom_body();
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
  const bool to_place = (p_odom_home_ || approach_m_ > 0.0) && !backing_off_;
  const PlanGoal::Kind kind = to_place ? PlanGoal::Kind::kRouteTo : goal_kind_;
  const double distance_m = backing_off_ ? goal_distance_m_ : kScanReachM;
  const bool backwards = backing_off_ && !route_back_odom_.empty();
  const auto& route_odom = backwards ? route_back_odom_ : route_odom_;
  PlanGoal goal{utime_, phase_.goal_id, kind, {}, distance_m, route_odom, {}};
  if (approach_m_ > 0.0) goal.route_odom = first_part_of(route_odom_, approach_m_);
  if (backing_off_) goal.traversed_path_odom = path_back_odom_;
  const Eigen::Vector2d p_odom_end =
      backing_off_ ? path_back_odom_.back().translation() : goal.route_odom.back();
  goal.T_odom_goal = {p_odom_end.x(), p_odom_end.y(), 0.0};
  return goal;
}

void Mission::note_failed_try(const std::string& reason) {
  ++failed_tries_;
  if (failed_tries_ > params_.failed_tries_max) {
    const bool never_left = traversed_path_.distance_travelled_m() < kStartRadiusM;
    end(never_left ? MissionOutcome::kHome : MissionOutcome::kStranded,
        (never_left ? "there is no way into the mine: " : "no way on was found: ") + reason);
  } else if (phase_.returning_home && has_map_ && rejoin_length_m() > 0.0) {
    rejoin(rejoin_length_m(), "exploration knows no way (" + reason + ")");
  } else {
    scan_straight_ahead("exploration knows no way (" + reason + "): straight on");
  }
}

}  // namespace adit
