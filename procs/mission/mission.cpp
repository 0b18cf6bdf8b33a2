// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mission/mission.hpp"

#include <utility>

#include "common/sensing/seconds.hpp"

namespace adit {
namespace {

constexpr double kAskAgainS = 2.0;       // a message may be lost
constexpr double kScanPatienceS = 30.0;  // a sweep takes eight seconds
constexpr double kPlanPatienceS = 10.0;
constexpr double kExplorationPatienceS = 300.0;  // it may be restarted, and wait for the map
constexpr double kDrivingSilentS = 3.0;
constexpr double kPoseSilentS = 1.0;

}  // namespace

void Mission::restore(const MissionPhase& last, std::int64_t begun_utime,
                      std::vector<KeptPlace> track) {
  restored_track_ = std::move(track);
  phase_ = {};
  begun_utime_ = begun_utime;
  restored_ = true;
  restored_utime_ = last.utime;
  phase_.sequence = last.sequence;
  phase_.homeward = last.homeward;
  phase_.homeward_reason = last.homeward_reason;
  phase_.goal_id = last.goal_id;
  phase_.scans = last.scans;
  phase_.travelled_m = last.travelled_m;
  phase_.laser = last.laser;
  way_.set_travelled(last.travelled_m);
  request_ = last.sequence;  // exploration answers each id once
  if (last.phase == Phase::kEnded || last.phase == Phase::kPaused) {
    phase_ = last;  // who was told to stand, stands
  } else if (last.phase == Phase::kWaiting) {
    phase_.reason = last.reason;
  } else {
    phase_.reason = "the mission was interrupted, after: " + last.reason;
  }
  limits_.begin(last.travelled_m);
  home_for_good_ = last.homeward && last.stub < 0;
}

void Mission::enter(Phase phase, const std::string& reason) {
  phase_.utime = phase_utime_ = utime_;
  ++phase_.sequence;
  phase_.phase = phase;
  phase_.reason = reason;
  asked_utime_ = 0;
  if (phase == Phase::kExplore) ++request_;
  if (phase == Phase::kPlan || phase == Phase::kExecute) return;
  backing_off_ = false;
  nearer_m_ = 0.0;
  goal_kind_ = PlanGoal::Kind::kRoute;
}

void Mission::end(MissionOutcome outcome, const std::string& reason) {
  phase_.outcome = outcome;
  enter(Phase::kEnded, reason);
}

void Mission::turn_around(const std::string& reason) {
  home_for_good_ = true;
  phase_.homeward = true;
  phase_.homeward_reason = reason;
  phase_.stub = -1;  // so that the journal says that it is for good
  verdict_.reset();
  enter(Phase::kExplore, "the robot turns around: " + reason);
}

double Mission::since_phase_s() const { return seconds(utime_ - phase_utime_); }

bool Mission::is_time_to_ask(double period_s) {
  if (asked_utime_ != 0 && seconds(utime_ - asked_utime_) < period_s) return false;
  asked_utime_ = utime_;
  return true;
}

MissionAsk Mission::advance(std::int64_t utime) {
  utime_ = utime;
  if (begun_utime_ == 0) begun_utime_ = utime;
  if (phase_utime_ == 0) phase_.utime = phase_utime_ = utime;
  phase_.travelled_m = way_.travelled_m();
  phase_.remaining_m = limits_.remaining_m(seconds(utime - begun_utime_), phase_.travelled_m);
  MissionAsk ask;
  const bool under_way = phase_.phase != Phase::kPaused && phase_.phase != Phase::kEnded;
  if (under_way && limits_.reason() && !home_for_good_) turn_around(*limits_.reason());
  switch (phase_.phase) {
    case Phase::kWaiting:
      wait(ask);
      break;
    case Phase::kExplore:
      explore(ask);
      break;
    case Phase::kScan:
      scan(ask);
      break;
    case Phase::kPlan:
      plan(ask);
      break;
    case Phase::kExecute:
      execute();
      break;
    case Phase::kPaused:
    case Phase::kEnded:
      break;
  }
  return ask;
}

/// For the stages, and after a restart for the map.
void Mission::wait(MissionAsk& ask) {
  if (phase_.sequence == 0 && !restored_ && params_.start == "by_order") {
    enter(Phase::kPaused, "it waits for the order to go");
    return;
  }
  const bool pose = way_.T_odom_body() && seconds(utime_ - way_.utime()) < kPoseSilentS;
  const bool driving = driving_ && seconds(utime_ - driving_utime_) < kDrivingSilentS;
  if (!pose || !driving) return;
  if (odom_is_new_ && !has_map_ && since_phase_s() < params_.relocalise_s) return;
  enter(Phase::kExplore, restored_ ? "it goes on" : "the robot is ready");
  explore(ask);
}

void Mission::explore(MissionAsk& ask) {
  if (odom_is_new_ && !has_map_) {
    go_by_sight("it does not know where it is on its map, and moves on to recognise a place");
    return;
  }
  if (since_phase_s() > kExplorationPatienceS) {
    lost_try("it does not answer");
    return;
  }
  if (!is_time_to_ask(kAskAgainS)) return;
  ask.explore = ExploreRequest{utime_, request_, phase_.remaining_m, home_for_good_, verdict_};
}

void Mission::scan(MissionAsk& ask) {
  if (since_phase_s() > kScanPatienceS) {
    if (++tries_ > params_.lost_tries_max) {
      end(MissionOutcome::kStranded, "no 3D scan comes any more");
      return;
    }
    look(tries_ % 2 == 0 ? other(phase_.laser) : phase_.laser, "no 3D scan came, so once more");
    return;
  }
  if (is_time_to_ask(kAskAgainS)) {
    ask.scan = ScanRequest{utime_, phase_.goal_id, phase_.laser};
  }
}

void Mission::plan(MissionAsk& ask) {
  if (since_phase_s() > kPlanPatienceS) {
    look(phase_.laser, "planning did not answer, so once more");
    return;
  }
  if (is_time_to_ask(kAskAgainS)) ask.goal = goal();
}

/// Of other outcomes than those that add_driving tells.
void Mission::execute() {
  if (seconds(utime_ - driving_utime_) > kDrivingSilentS) {
    refuse(0.0, "Driving is silent.", Attempt::Evidence::kDrive);
  }
}

}  // namespace adit
