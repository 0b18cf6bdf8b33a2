// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// What the mission tries where there is no path.
#include <algorithm>

#include "procs/mission/mission.hpp"

namespace adit {
namespace {

constexpr double kGotOnM = 1.0;  // that counts as having got on

using Evidence = Attempt::Evidence;

}  // namespace

void Mission::refuse(double reached_m, const std::string& reason, Evidence evidence) {
  if (attempt_.refusals() == 0 && way_.T_odom_body()) {
    refused_.add(way_.T_odom_body()->translation());
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
    const std::string said = attempt_.evidence();
    attempt_.got_on();
    lost_try(said);
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
  return refused_.all_beyond(kGotOnM, way_.T_odom_body()->translation());
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

}  // namespace adit
