// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// What the mission makes of the answers of the stages.
#include <utility>

#include "procs/mission/mission.hpp"

namespace adit {
namespace {

constexpr int kIncompleteScansMax = 3;  // scans in a row; then what there is has to do
constexpr double kLostPathS = 2.0;      // until driving should have its path
constexpr double kSameM = 0.01;         // of two places that are one

using Kind = ExplorationDecision::Kind;
using Evidence = RetryPolicy::Evidence;

/// In odom, where the route of a report ends there.
std::optional<Eigen::Vector2d> home_of(const ExplorationReport& report) {
  if (report.decision.kind != Kind::kHome || report.route_odom.empty()) return std::nullopt;
  const Eigen::Vector2d p_odom_goal = report.T_odom_goal.translation();
  if ((report.route_odom.back() - p_odom_goal).norm() > kSameM) return std::nullopt;
  return p_odom_goal;
}

}  // namespace

void Mission::add_exploration(const ExplorationReport& report) {
  if (report.request == 0) return;
  if (phase_.phase == Phase::kExplore && report.request == request_) decide(report);
}

void Mission::decide(const ExplorationReport& report) {
  const ExplorationDecision& decision = report.decision;
  phase_.complete = decision.complete;
  if (decision.kind == Kind::kStay && report.revision == 0 && !restored_ && !odom_is_new_) {
    scan_straight_ahead("there is no map yet: straight on");
    return;
  }
  if (decision.kind == Kind::kStay) {
    if (since_phase_s() > params_.exploration_wait_s) note_failed_try(decision.reason);
    return;
  }
  verdict_.reset();
  if (decision.kind == Kind::kDone) {
    end(MissionOutcome::kHome, "the robot is at home: " + decision.reason);
    return;
  }
  const bool home = decision.kind == Kind::kHome;
  if (home && !phase_.returning_home) phase_.return_home_reason = decision.reason;
  if (!home && !return_is_final_) phase_.return_home_reason.clear();
  phase_.returning_home = home || return_is_final_;
  phase_.frontier = decision.frontier;
  without_target_ = false;
  if (retry_policy_.set_target(decision.frontier, home)) {
    rejoin_count_ = 0;
    homeward_progress_.begin();
  }
  if (home && homeward_progress_.note_progress(decision.distance_m)) note_progress();
  p_odom_home_ = home_of(report);
  if (!home) home_retries_ = 0;
  if (is_near_home() && ++home_retries_ > params_.home_retries) {
    end_near_home(decision.reason);
    return;
  }
  scan_along(report.route_odom, decision.reason);
}

/// A scan that was cut short, since the robot moved or a laser was silent, is not one to judge by.
void Mission::add_cloud(std::int32_t id, bool complete) {
  if (phase_.phase != Phase::kScan || id != phase_.goal_id || complete) return;
  if (++scan_tries_ <= kIncompleteScansMax)
    request_scan(phase_.laser, "the scan was cut short, so once more");
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
  evaluate_path(path);
}

void Mission::evaluate_path(const PlannedPath& path) {
  if (path.outcome == PlanOutcome::kFound) {
    distance_at_last_scan_m_ = traversed_path_.distance_travelled_m();
    driving_utime_ = utime_;
    enter(Phase::kExecute, path.reason);
    return;
  }
  if (goal_kind_ == PlanGoal::Kind::kRetrace) {
    back_off_by_planning(path.reason);
    return;
  }
  if (backing_off_) {
    backing_off_ = false;
    path_back_failed_ = true;
    reject(retry_policy_.reached_m(), "Nor is there a way back: " + path.reason,
           Evidence::kDriveFailed);
    return;
  }
  if (approach_m_ > 0.0) {
    approach_m_ = 0.0;
    reject(path.reached_m, "Nor does it get nearer: " + path.reason, Evidence::kUnobserved);
    return;
  }
  // Where nothing at all is named that is in the way, nobody saw it.
  const bool seen = path.outcome == PlanOutcome::kBlocked && !path.blocking.empty();
  const bool narrow = path.outcome == PlanOutcome::kNarrow;
  reject(path.reached_m, path.reason,
         seen     ? Evidence::kObserved
         : narrow ? Evidence::kNarrow
                  : Evidence::kUnobserved);
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
    const bool away = backing_off_ && goal_kind_ != PlanGoal::Kind::kRejoin;
    path_back_failed_ = false;
    if (!away && !is_returning() && is_beyond_rejections()) note_progress();
    if (!away && path_ends_.add_and_check_stuck(traversed_path_.T_odom_body()->translation())) {
      reject(0.0, "Path after path ended at the same place.", Evidence::kDriveFailed);
      return;
    }
    enter(Phase::kExplore, "it has come to the end of the path");
  } else if (state.kind == DrivingState::Kind::kFailed) {
    drive_failed("Driving gave up: " + state.reason + ".");
  }
}

}  // namespace adit
