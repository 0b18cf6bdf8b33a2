// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// What the mission tries where there is no path.
#include <algorithm>
#include <cstdio>

#include "procs/mission/mission.hpp"

namespace adit {
namespace {

constexpr double kGotOnM = 1.0;     // that counts as having got on
constexpr double kLedBackM = 0.1;   // by a track; less is none
constexpr double kSharedM = 2.5;    // of a route, to go on the own track instead
constexpr double kRejoinedM = 6.0;  // to go on it, at first
constexpr double kRejoinedMaxM = 30.0;
constexpr double kTrackInSightM = 10.0;   // that may be come to
constexpr double kBeyondReachedM = 1.0;   // where what is in the way may lie
constexpr double kLittleM = 1.2;          // back; from the nose to the middle of the vehicle
constexpr double kShortOfReachedM = 0.3;  // to end where there is some room

using Evidence = Attempt::Evidence;

}  // namespace

void Mission::refuse(double reached_m, const std::string& reason, Evidence evidence) {
  if (is_nearly_home()) {
    refuse_nearly_home(reason);
    return;
  }
  if (evidence == Evidence::kNarrow) narrow_stubs_.insert(phase_.stub);
  if (attempt_.refusals() == 0 && way_.T_odom_body()) {
    refused_.add(way_.T_odom_body()->translation());
  }
  if (attempt_.refusals() > 0) take_track_as_believed();
  const bool may_back_off = way_.back_m(params_.back_off_m) > kGotOnM;
  const bool short_cut = is_short_cut_home(reached_m);
  const double track_m = short_cut ? 0.0 : track_that_leads_there_m();
  const Attempt::Next next = attempt_.refuse(utime_, reached_m, reason, evidence, may_back_off);
  const bool moves_on = next != Attempt::Next::kLookAgain && next != Attempt::Next::kGiveUp;
  if (moves_on && track_m > 0.0) return rejoin(track_m, reason);
  switch (next) {
    case Attempt::Next::kBeside:
      back_off(kLittleM, reason);
      return;
    case Attempt::Next::kNearer:
      go_nearer(reached_m, reason);
      return;
    case Attempt::Next::kOtherLaser:
      look(other(phase_.laser),
           "the ground is not known well enough, so it looks to the other side: " + reason);
      return;
    case Attempt::Next::kBackOff:
      if (short_cut) break;
      back_off(std::max(1, attempt_.back_offs()) * params_.back_off_m, reason);
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
  const bool doubtful = attempt_.is_doubtful() || narrow_stubs_.contains(phase_.stub);
  verdict_ = BlockedVerdict{attempt_.utime(), phase_.stub, attempt_.reached_m(),
                            attempt_.evidence(), doubtful};
  attempt_.got_on();
  way_home_.judge();
  if (phase_.stub < 0 && ++lost_tries_ > params_.lost_tries_max) {
    end(MissionOutcome::kStranded, "no way on was found: " + verdict_->evidence);
    return;
  }
  enter(Phase::kExplore,
        (verdict_->doubtful ? "no way is found: " : "the way is blocked: ") + verdict_->evidence);
}

/// After a cut the map may know only about where odom lies, until the robot has moved; and without
/// its track it does not move. It stands where it was cut off, and the guard watches.
void Mission::take_track_as_believed() {
  if (way_.is_tied() || !T_map_odom_ || limits_.is_unmeasured()) return;
  way_.tie(*T_map_odom_);
}

void Mission::got_on() {
  attempt_.got_on();
  rejoined_ = 0;
  lost_tries_ = 0;
}

bool Mission::is_nearly_home() const {
  if (!p_odom_home_ || !way_.T_odom_body()) return false;
  return (way_.T_odom_body()->translation() - *p_odom_home_).norm() <= params_.nearly_home_m;
}

/// To wander about for the last decimetres is worth nothing.
void Mission::refuse_nearly_home(const std::string& reason) {
  if (++nearly_home_tries_ > params_.nearly_home_tries) {
    end_nearly_home(reason);
  } else {
    look(other(phase_.laser), "it is nearly home, and looks to the other side: " + reason);
  }
}

void Mission::end_nearly_home(const std::string& reason) {
  char where[64];
  std::snprintf(where, sizeof where, ", %.2f m from the start, and comes no nearer: ",
                (way_.T_odom_body()->translation() - *p_odom_home_).norm());
  end(MissionOutcome::kHome, "the robot is at home" + (where + reason));
}

/// From afar what lies behind a rail or round a corner is in shadow; from nearer it is not.
void Mission::go_nearer(double reached_m, const std::string& reason) {
  nearer_m_ = reached_m - kShortOfReachedM;
  ++phase_.goal_id;
  enter(Phase::kPlan, "it goes nearer to see more: " + reason);
}

/// What it came over carried it, whatever the scans say of it. Where that drive failed, what the
/// scans say is all there is.
void Mission::back_off(double distance_m, const std::string& reason) {
  backing_off_ = true;
  goal_distance_m_ = distance_m;
  track_odom_ = way_.back(goal_distance_m_);
  route_back_odom_.clear();
  for (const Pose2& T_odom_place : track_odom_) {
    route_back_odom_.push_back(T_odom_place.translation());
  }
  goal_kind_ = track_failed_ ? PlanGoal::Kind::kRoute : PlanGoal::Kind::kRetrace;
  ++phase_.goal_id;
  enter(Phase::kPlan, "it backs off to look from another place: " + reason);
}

void Mission::back_off_as_planned(const std::string& reason) {
  goal_kind_ = PlanGoal::Kind::kRoute;
  ++phase_.goal_id;
  enter(Phase::kPlan, "it backs off by what it sees: " + reason);
}

/// Whether the route home left the own track before it was refused. Nothing is lost with a short
/// cut, unless exploration knows no other way: then it is none.
bool Mission::is_short_cut_home(double reached_m) const {
  if (!is_led_home() || way_home_.was_judged() || !leads_back()) return false;
  return way_.shared_m(route_odom_) < reached_m + kBeyondReachedM;
}

bool Mission::leads_back() const { return way_.back_m(kGotOnM) > kLedBackM; }

/// How far it may go to where it is to go on its own track; 0 where that does not lead there. On
/// the way home it does, if by a detour: so it goes the farther the more often it had to.
double Mission::track_that_leads_there_m() const {
  if (track_failed_) return 0.0;
  const double shared_m = way_.shared_m(route_odom_);
  if (!phase_.homeward) return shared_m < kSharedM ? 0.0 : std::min(shared_m, kRejoinedM);
  const int times = 1 + rejoined_ / 2;
  return leads_back() ? std::min(kRejoinedM * times, kRejoinedMaxM) : 0.0;
}

/// What lies between it and its own track it can see; on the track it need not. Before the first
/// look in a new odom it sees nothing.
void Mission::rejoin(double length_m, const std::string& reason) {
  backing_off_ = true;
  ++rejoined_;
  goal_distance_m_ = length_m;
  track_odom_ = way_.back_within(length_m + kTrackInSightM);
  route_back_odom_.clear();
  const bool sees = terrain_utime_ >= odom_utime_;
  goal_kind_ = sees ? PlanGoal::Kind::kRejoin : PlanGoal::Kind::kRetrace;
  ++phase_.goal_id;
  enter(Phase::kPlan, "it goes on along its own track: " + reason);
}

/// Back to where it was once refused is not on.
bool Mission::is_beyond_refusals() const {
  if (way_.travelled_m() - progress_mark_m_ < kGotOnM || !way_.T_odom_body()) return false;
  return refused_.all_beyond(kGotOnM, way_.T_odom_body()->translation());
}

/// On the way back that says nothing of what lies ahead, and it may be another place already. Who
/// does not know how it moves leaves it at that: it could be led anywhere, out of the mine, too.
void Mission::drive_failed(const std::string& reason) {
  if (limits_.is_unmeasured()) {
    end(MissionOutcome::kStranded, "it does not know any more where it is: " + reason);
    return;
  }
  if (backing_off_) {
    track_failed_ = goal_kind_ != PlanGoal::Kind::kRoute;
    enter(Phase::kExplore, "it looks from where it got to: " + reason);
    return;
  }
  if (!is_led_home() && is_beyond_refusals()) attempt_.got_on();
  refuse(0.0, reason, Evidence::kDrive);
}

}  // namespace adit
