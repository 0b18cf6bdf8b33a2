// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mission/mission.hpp"

#include <utility>

#include "common/sensing/seconds.hpp"

namespace adit {
namespace {

constexpr double kRequestPeriodS = 2.0;  // a message may be lost
constexpr double kScanTimeoutS = 30.0;   // a sweep takes eight seconds
constexpr double kPlanTimeoutS = 10.0;
constexpr double kExplorationTimeoutS = 300.0;  // it may be restarted, and wait for the map
constexpr double kDrivingTimeoutS = 3.0;
constexpr double kPoseTimeoutS = 1.0;

}  // namespace

void Mission::restore(const MissionPhase& last, std::int64_t start_utime,
                      std::vector<StoredPathPose> track) {
  restored_path_ = std::move(track);
  phase_ = {};
  start_utime_ = start_utime;
  restored_ = true;
  restored_utime_ = last.utime;
  phase_.sequence = last.sequence;
  phase_.returning_home = last.returning_home;
  phase_.return_home_reason = last.return_home_reason;
  phase_.goal_id = last.goal_id;
  phase_.scans = last.scans;
  phase_.distance_travelled_m = last.distance_travelled_m;
  phase_.laser = last.laser;
  traversed_path_.set_distance_travelled(last.distance_travelled_m);
  request_ = last.sequence;  // exploration answers each id once
  if (last.phase == Phase::kEnded || last.phase == Phase::kPaused) {
    phase_ = last;  // who was told to stand, stands
  } else if (last.phase == Phase::kWaiting) {
    phase_.reason = last.reason;
  } else {
    phase_.reason = "the mission was interrupted, after: " + last.reason;
  }
  limits_.begin(last.distance_travelled_m);
  return_is_final_ = last.returning_home && last.frontier < 0;
}

void Mission::enter(Phase phase, const std::string& reason) {
  phase_.utime = phase_utime_ = utime_;
  ++phase_.sequence;
  phase_.phase = phase;
  phase_.reason = reason;
  requested_utime_ = 0;
  if (phase == Phase::kExplore) ++request_;
  if (phase == Phase::kPlan || phase == Phase::kExecute) return;
  backing_off_ = false;
  approach_m_ = 0.0;
  goal_kind_ = PlanGoal::Kind::kRoute;
}

void Mission::end(MissionOutcome outcome, const std::string& reason) {
  phase_.outcome = outcome;
  enter(Phase::kEnded, reason);
}

void Mission::turn_around(const std::string& reason) {
  return_is_final_ = true;
  phase_.returning_home = true;
  phase_.return_home_reason = reason;
  phase_.frontier = -1;  // so that the journal says that it is for good
  verdict_.reset();
  enter(Phase::kExplore, "the robot turns around: " + reason);
}

double Mission::since_phase_s() const { return seconds(utime_ - phase_utime_); }

bool Mission::request_is_due(double period_s) {
  if (requested_utime_ != 0 && seconds(utime_ - requested_utime_) < period_s) return false;
  requested_utime_ = utime_;
  return true;
}

MissionRequests Mission::advance(std::int64_t utime) {
  utime_ = utime;
  if (start_utime_ == 0) start_utime_ = utime;
  if (phase_utime_ == 0) phase_.utime = phase_utime_ = utime;
  phase_.distance_travelled_m = traversed_path_.distance_travelled_m();
  phase_.remaining_m =
      limits_.remaining_m(seconds(utime - start_utime_), phase_.distance_travelled_m);
  MissionRequests requests;
  const bool under_way = phase_.phase != Phase::kPaused && phase_.phase != Phase::kEnded;
  if (under_way && limits_.reason() && !return_is_final_) turn_around(*limits_.reason());
  switch (phase_.phase) {
    case Phase::kWaiting:
      wait(requests);
      break;
    case Phase::kExplore:
      explore(requests);
      break;
    case Phase::kScan:
      scan(requests);
      break;
    case Phase::kPlan:
      plan(requests);
      break;
    case Phase::kExecute:
      execute();
      break;
    case Phase::kPaused:
    case Phase::kEnded:
      break;
  }
  return requests;
}

/// For the stages, and after a restart for the map.
void Mission::wait(MissionRequests& requests) {
  if (phase_.sequence == 0 && !restored_ && params_.start == "on_order") {
    enter(Phase::kPaused, "it waits for the order to go");
    return;
  }
  const bool pose =
      traversed_path_.T_odom_body() && seconds(utime_ - traversed_path_.utime()) < kPoseTimeoutS;
  const bool driving = driving_ && seconds(utime_ - driving_utime_) < kDrivingTimeoutS;
  if (!pose || !driving) return;
  if (odom_is_new_ && !has_map_ && since_phase_s() < params_.relocalization_wait_s) return;
  enter(Phase::kExplore, restored_ ? "it goes on" : "the robot is ready");
  explore(requests);
}

void Mission::explore(MissionRequests& requests) {
  if (odom_is_new_ && !has_map_) {
    scan_straight_ahead(
        "it does not know where it is on its map, and moves on to recognise a place");
    return;
  }
  if (since_phase_s() > kExplorationTimeoutS) {
    note_failed_try("it does not answer");
    return;
  }
  if (!request_is_due(kRequestPeriodS)) return;
  requests.explore =
      ExploreRequest{utime_, request_, phase_.remaining_m, return_is_final_, verdict_};
}

void Mission::scan(MissionRequests& requests) {
  if (since_phase_s() > kScanTimeoutS) {
    if (++scan_tries_ > params_.failed_tries_max) {
      end(MissionOutcome::kStranded, "no 3D scan comes any more");
      return;
    }
    request_scan(scan_tries_ % 2 == 0 ? other(phase_.laser) : phase_.laser,
                 "no 3D scan came, so once more");
    return;
  }
  if (request_is_due(kRequestPeriodS)) {
    requests.scan = ScanRequest{utime_, phase_.goal_id, phase_.laser};
  }
}

void Mission::plan(MissionRequests& requests) {
  if (since_phase_s() > kPlanTimeoutS) {
    request_scan(phase_.laser, "planning did not answer, so once more");
    return;
  }
  if (request_is_due(kRequestPeriodS)) requests.goal = goal();
}

/// Of other outcomes than those that add_driving tells.
void Mission::execute() {
  if (seconds(utime_ - driving_utime_) > kDrivingTimeoutS) {
    reject(0.0, "Driving is silent.", RetryPolicy::Evidence::kDriveFailed);
  }
}

}  // namespace adit
