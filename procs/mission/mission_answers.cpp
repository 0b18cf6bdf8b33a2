// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// What the mission makes of what the stages say.
#include <algorithm>
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
constexpr int kCutShortMax = 3;     // scans in a row; then what there is has to do
constexpr double kGotOnM = 1.0;     // that counts as having got on
constexpr double kLostPathS = 2.0;  // until driving should have its path

using Kind = ExplorationDecision::Kind;
using Evidence = Attempt::Evidence;

}  // namespace

void Mission::add_pose(std::int64_t utime, const Pose2& T_odom_body) {
  way_.add(utime, T_odom_body);
}

/// Where scan matching begins anew, so does odom, and what was planned in it is of no use.
void Mission::add_match(const ScanMatch& match) {
  const bool drives = driving_ && driving_->kind == DrivingState::Kind::kDriving;
  if (moves() && drives) limits_.add(match);
  if (match.odom_utime == odom_utime_) return;
  const bool first_heard = odom_utime_ == 0;
  odom_utime_ = match.odom_utime;
  if (first_heard && match.odom_utime <= restored_utime_) return;
  if (first_heard && !restored_) return;
  odom_is_new_ = true;
  has_map_ = false;
  way_.begin_anew();
  refused_odom_.clear();
  if (phase_.phase == Phase::kPaused || phase_.phase == Phase::kEnded) return;
  if (first_heard && !home_for_good_ && params_.after_cut_off == "home") {
    home_for_good_ = phase_.homeward = true;
    phase_.homeward_reason = "the computer was off";
  }
  enter(Phase::kWaiting, "odom begins anew: it waits to know where it is on its map");
}

void Mission::add_correction(const MapCorrection& correction) {
  limits_.add(correction);
  if (correction.utime >= odom_utime_) has_map_ = true;
}

void Mission::add_exploration(const ExplorationReport& report) {
  if (report.request == 0) return;
  if (phase_.phase == Phase::kExplore && report.request == request_) decide(report);
}

void Mission::decide(const ExplorationReport& report) {
  const ExplorationDecision& decision = report.decision;
  phase_.complete = decision.complete;
  if (decision.kind == Kind::kStay && report.revision == 0 && !restored_ && !odom_is_new_) {
    go_by_sight("there is no map yet: straight on");
    return;
  }
  if (decision.kind == Kind::kStay) {
    if (since_phase_s() > params_.stay_s) lost_try(decision.reason);
    return;
  }
  verdict_.reset();
  if (decision.kind == Kind::kDone) {
    end(MissionOutcome::kHome, "the robot is at home: " + decision.reason);
    return;
  }
  const bool home = decision.kind == Kind::kHome;
  if (home && !phase_.homeward) phase_.homeward_reason = decision.reason;
  if (!home && !home_for_good_) phase_.homeward_reason.clear();
  phase_.homeward = home || home_for_good_;
  phase_.stub = decision.stub;
  by_sight_ = false;
  attempt_.aim_at(decision.stub, home);
  look_along(report.route_odom, decision.reason);
}

void Mission::lost_try(const std::string& reason) {
  ++lost_tries_;
  if (lost_tries_ > params_.lost_tries_max) {
    const bool never_left = way_.travelled_m() < kNeverLeftM;
    end(never_left ? MissionOutcome::kHome : MissionOutcome::kStranded,
        (never_left ? "there is no way into the mine: " : "no way on was found: ") + reason);
  } else {
    go_by_sight("exploration knows no way (" + reason + "): straight on");
  }
}

/// Where the body looks, or, if that was in vain, back where it came from.
void Mission::go_by_sight(const std::string& reason) {
  if (!way_.T_odom_body()) return;
  phase_.stub = -1;
  by_sight_ = true;
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
  PlanGoal goal{utime_, phase_.goal_id, goal_kind_, {}, kSightM, route_odom_};
  goal.T_odom_goal = {route_odom_.back().x(), route_odom_.back().y(), 0.0};
  return goal;
}

/// A scan that was cut short, since the robot moved or a laser was silent, is not one to judge by.
void Mission::add_cloud(std::int32_t id, bool complete) {
  if (phase_.phase != Phase::kScan || id != phase_.goal_id || complete) return;
  if (++tries_ <= kCutShortMax) look(phase_.laser, "the scan was cut short, so once more");
}

void Mission::add_terrain(std::int64_t utime, std::int32_t id) {
  if (phase_.phase != Phase::kScan || id != phase_.goal_id) return;
  ++phase_.scans;
  terrain_utime_ = utime;
  enter(Phase::kPlan, "the scan is there");
}

void Mission::add_path(const PlannedPath& path) {
  if (phase_.phase != Phase::kPlan || path.id != phase_.goal_id) return;
  if (path.utime < terrain_utime_ && !backing_off_) return;  // planned on the scan before
  judge(path);
}

void Mission::judge(const PlannedPath& path) {
  if (path.outcome == PlanOutcome::kFound) {
    progress_mark_m_ = way_.travelled_m();
    driving_utime_ = utime_;
    enter(Phase::kExecute, path.reason);
    return;
  }
  if (backing_off_ && goal_kind_ != PlanGoal::Kind::kRetrace) {
    retrace(path.reason);
    return;
  }
  if (backing_off_) {
    backing_off_ = false;
    refuse(attempt_.reached_m(), "Nor is there a way back: " + path.reason, Evidence::kDrive);
    return;
  }
  // Where nothing at all is named that is in the way, nobody saw it.
  const bool seen = path.outcome == PlanOutcome::kBlocked && !path.blocking.empty();
  refuse(path.reached_m, path.reason, seen ? Evidence::kSeen : Evidence::kUnseen);
}

void Mission::refuse(double reached_m, const std::string& reason, Evidence evidence) {
  if (attempt_.refusals() == 0 && way_.T_odom_body()) {
    refused_odom_.push_back(way_.T_odom_body()->translation());
  }
  const bool may_back_off = way_.back(params_.back_off_m).size() > 5;
  switch (attempt_.refuse(utime_, reached_m, reason, evidence, may_back_off)) {
    case Attempt::Next::kOtherLaser:
      look(phase_.laser == LaserId::kFront ? LaserId::kRear : LaserId::kFront,
           "the ground is not known well enough, so it looks to the other side: " + reason);
      return;
    case Attempt::Next::kBackOff:
      back_off(reason);
      return;
    case Attempt::Next::kLookAgain:
      enter(Phase::kExplore, "it looks once more: " + reason);
      return;
    case Attempt::Next::kGiveUp:
      break;
  }
  if (by_sight_) {  // nobody's target is blocked
    const std::string evidence = attempt_.evidence();
    attempt_.got_on();
    lost_try(evidence);
    return;
  }
  verdict_ = BlockedVerdict{attempt_.utime(), phase_.stub, attempt_.reached_m(),
                            attempt_.evidence(), attempt_.is_doubtful()};
  attempt_.got_on();
  if (phase_.stub < 0 && ++lost_tries_ > params_.lost_tries_max) {
    end(MissionOutcome::kStranded, "no way on was found: " + verdict_->evidence);
    return;
  }
  enter(Phase::kExplore,
        (verdict_->doubtful ? "no way is found: " : "the way is blocked: ") + verdict_->evidence);
}

void Mission::back_off(const std::string& reason) {
  backing_off_ = true;
  route_odom_ = way_.back(std::max(1, attempt_.back_offs()) * params_.back_off_m);
  goal_kind_ = PlanGoal::Kind::kRoute;
  ++phase_.goal_id;
  enter(Phase::kPlan, "it backs off to look from another place: " + reason);
}

/// What it came over carried it, whatever the scans say of it.
void Mission::retrace(const std::string& reason) {
  goal_kind_ = PlanGoal::Kind::kRetrace;
  ++phase_.goal_id;
  enter(Phase::kPlan, "it goes back on its own track: " + reason);
}

/// Back to where it was once refused is not on.
bool Mission::got_on() const {
  if (way_.travelled_m() - progress_mark_m_ < kGotOnM || !way_.T_odom_body()) return false;
  const Eigen::Vector2d p_odom_body = way_.T_odom_body()->translation();
  return std::all_of(
      refused_odom_.begin(), refused_odom_.end(),
      [&](const Eigen::Vector2d& p_odom) { return (p_odom_body - p_odom).norm() > kGotOnM; });
}

void Mission::add_driving(const DrivingState& state) {
  driving_ = state;
  driving_utime_ = utime_;
  if (!moves()) return;
  if (state.path_id != phase_.goal_id || state.kind == DrivingState::Kind::kIdle) {
    if (since_phase_s() > kLostPathS) enter(Phase::kExplore, "driving has lost its path");
    return;
  }
  if (state.kind == DrivingState::Kind::kArrived) {
    if (!backing_off_ && got_on()) {
      attempt_.got_on();
      lost_tries_ = 0;
    }
    enter(Phase::kExplore, "it has come to the end of the path");
  } else if (state.kind == DrivingState::Kind::kFailed) {
    drive_failed("Driving gave up: " + state.reason + ".");
  }
}

/// On the way back that says nothing of what lies ahead, and it may be another place already.
void Mission::drive_failed(const std::string& reason) {
  if (backing_off_) {
    enter(Phase::kExplore, "it looks from where it got to: " + reason);
    return;
  }
  if (got_on()) attempt_.got_on();
  refuse(0.0, reason, Evidence::kDrive);
}

void Mission::add_order(const MissionOrder& order) {
  using Order = MissionOrder::Kind;
  if (phase_.phase == Phase::kEnded) return;
  const bool paused = phase_.phase == Phase::kPaused;
  if (order.kind == Order::kPause && !paused) {
    enter(Phase::kPaused, "by order");
  } else if (order.kind == Order::kGoOn && paused) {
    enter(Phase::kWaiting, "by order it goes on");
  } else if (order.kind == Order::kComeHome && !home_for_good_) {
    turn_around("by order");
  } else if (order.kind == Order::kStop) {
    end(MissionOutcome::kStopped, "by order");
  }
}

}  // namespace adit
