// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// What the mission tries where there is no path.
#include <algorithm>
#include <cstdio>

#include "procs/mission/mission.hpp"

namespace adit {
namespace {

constexpr double kProgressMinM = 1.0;  // that counts as having got on
constexpr double kBackMinM = 0.1;      // by a track; less is none
constexpr double kSharedMinM = 2.5;    // of a route, to go on the own track instead
constexpr double kRejoinM = 6.0;       // to go on it, at first
constexpr double kRejoinMaxM = 30.0;
constexpr double kPathInViewM = 10.0;     // that may be come to
constexpr double kObstacleDepthM = 1.0;   // where what is in the way may lie
constexpr double kBackOffBesideM = 1.2;   // back; from the nose to the middle of the vehicle
constexpr double kApproachMarginM = 0.3;  // to end where there is some room

using Evidence = RetryPolicy::Evidence;

}  // namespace

void Mission::reject(double reached_m, const std::string& reason, Evidence evidence) {
  if (is_near_home()) {
    retry_near_home(reason);
    return;
  }
  if (evidence == Evidence::kNarrow) narrow_frontiers_.insert(phase_.frontier);
  if (retry_policy_.rejections() == 0 && traversed_path_.T_odom_body()) {
    rejected_.add(traversed_path_.T_odom_body()->translation());
  }
  if (retry_policy_.rejections() > 0) anchor_path_to_estimate();
  const bool may_back_off = traversed_path_.back_length_m(params_.back_off_m) > kProgressMinM;
  const bool short_cut = is_short_cut_home(reached_m);
  const double track_m = short_cut ? 0.0 : rejoin_length_m();
  const RetryPolicy::Action action =
      retry_policy_.reject(utime_, reached_m, reason, evidence, may_back_off);
  const bool moves_on =
      action != RetryPolicy::Action::kRescan && action != RetryPolicy::Action::kAbandon;
  if (moves_on && track_m > 0.0) return rejoin(track_m, reason);
  switch (action) {
    case RetryPolicy::Action::kScanBeside:
      back_off(kBackOffBesideM, reason);
      return;
    case RetryPolicy::Action::kApproach:
      approach(reached_m, reason);
      return;
    case RetryPolicy::Action::kScanOtherLaser:
      request_scan(other(phase_.laser),
                   "the ground is not known well enough, so it looks to the other side: " + reason);
      return;
    case RetryPolicy::Action::kBackOff:
      if (short_cut) break;
      back_off(std::max(1, retry_policy_.back_offs()) * params_.back_off_m, reason);
      return;
    case RetryPolicy::Action::kRescan:
      enter(Phase::kExplore, "it looks once more: " + reason);
      return;
    case RetryPolicy::Action::kAbandon:
      break;
  }
  if (without_target_) {  // nobody's target is blocked
    const std::string said = retry_policy_.evidence();
    retry_policy_.note_progress();
    note_failed_try(said);
    return;
  }
  const bool uncertain =
      retry_policy_.is_uncertain() || narrow_frontiers_.contains(phase_.frontier);
  verdict_ = BlockedVerdict{retry_policy_.utime(), phase_.frontier, retry_policy_.reached_m(),
                            retry_policy_.evidence(), uncertain};
  retry_policy_.note_progress();
  homeward_progress_.mark_blocked();
  if (phase_.frontier < 0 && ++failed_tries_ > params_.failed_tries_max) {
    end(MissionOutcome::kStranded, "no way on was found: " + verdict_->evidence);
    return;
  }
  enter(Phase::kExplore,
        (verdict_->unconfirmed ? "no way is found: " : "the way is blocked: ") + verdict_->evidence);
}

/// After a cut the map may know only about where odom lies, until the robot has moved; and without
/// its track it does not move. It stands where it was cut off, and the guard watches.
void Mission::anchor_path_to_estimate() {
  if (traversed_path_.is_anchored() || !T_map_odom_ || limits_.is_unmeasured()) return;
  traversed_path_.anchor(*T_map_odom_);
}

void Mission::note_progress() {
  retry_policy_.note_progress();
  rejoin_count_ = 0;
  failed_tries_ = 0;
}

bool Mission::is_near_home() const {
  if (!p_odom_home_ || !traversed_path_.T_odom_body()) return false;
  return (traversed_path_.T_odom_body()->translation() - *p_odom_home_).norm() <=
         params_.home_tolerance_m;
}

/// To wander about for the last decimetres is worth nothing.
void Mission::retry_near_home(const std::string& reason) {
  if (++home_retries_ > params_.home_retries) {
    end_near_home(reason);
  } else {
    request_scan(other(phase_.laser), "it is nearly home, and looks to the other side: " + reason);
  }
}

void Mission::end_near_home(const std::string& reason) {
  char where[64];
  std::snprintf(where, sizeof where, ", %.2f m from the start, and comes no nearer: ",
                (traversed_path_.T_odom_body()->translation() - *p_odom_home_).norm());
  end(MissionOutcome::kHome, "the robot is at home" + (where + reason));
}

/// From afar what lies behind a rail or round a corner is in shadow; from nearer it is not.
void Mission::approach(double reached_m, const std::string& reason) {
  approach_m_ = reached_m - kApproachMarginM;
  ++phase_.goal_id;
  enter(Phase::kPlan, "it goes nearer to see more: " + reason);
}

/// What it came over carried it, whatever the scans say of it. Where that drive failed, what the
/// scans say is all there is.
void Mission::back_off(double distance_m, const std::string& reason) {
  backing_off_ = true;
  goal_distance_m_ = distance_m;
  path_back_odom_ = traversed_path_.back(goal_distance_m_);
  route_back_odom_.clear();
  for (const Pose2& T_odom_place : path_back_odom_) {
    route_back_odom_.push_back(T_odom_place.translation());
  }
  goal_kind_ = path_back_failed_ ? PlanGoal::Kind::kRoute : PlanGoal::Kind::kRetrace;
  ++phase_.goal_id;
  enter(Phase::kPlan, "it backs off to look from another place: " + reason);
}

void Mission::back_off_by_planning(const std::string& reason) {
  goal_kind_ = PlanGoal::Kind::kRoute;
  ++phase_.goal_id;
  enter(Phase::kPlan, "it backs off by what it sees: " + reason);
}

/// Whether the route home left the own track before it was refused. Nothing is lost with a short
/// cut, unless exploration knows no other way: then it is none.
bool Mission::is_short_cut_home(double reached_m) const {
  if (!is_returning() || homeward_progress_.was_blocked() || !path_leads_back()) return false;
  return traversed_path_.shared_length_m(route_odom_) < reached_m + kObstacleDepthM;
}

bool Mission::path_leads_back() const {
  return traversed_path_.back_length_m(kProgressMinM) > kBackMinM;
}

/// How far it may go to where it is to go on its own track; 0 where that does not lead there. On
/// the way home it does, if by a detour: so it goes the farther the more often it had to.
double Mission::rejoin_length_m() const {
  if (path_back_failed_) return 0.0;
  const double shared_length_m = traversed_path_.shared_length_m(route_odom_);
  if (!phase_.returning_home)
    return shared_length_m < kSharedMinM ? 0.0 : std::min(shared_length_m, kRejoinM);
  const int times = 1 + rejoin_count_ / 2;
  return path_leads_back() ? std::min(kRejoinM * times, kRejoinMaxM) : 0.0;
}

/// What lies between it and its own track it can see; on the track it need not. Before the first
/// look in a new odom it sees nothing.
void Mission::rejoin(double length_m, const std::string& reason) {
  backing_off_ = true;
  ++rejoin_count_;
  goal_distance_m_ = length_m;
  path_back_odom_ = traversed_path_.poses_back_within(length_m + kPathInViewM);
  route_back_odom_.clear();
  const bool sees = terrain_utime_ >= odom_epoch_utime_;
  goal_kind_ = sees ? PlanGoal::Kind::kRejoin : PlanGoal::Kind::kRetrace;
  ++phase_.goal_id;
  enter(Phase::kPlan, "it goes on along its own track: " + reason);
}

/// Back to where it was once refused is not on.
bool Mission::is_beyond_rejections() const {
  if (traversed_path_.distance_travelled_m() - distance_at_last_scan_m_ < kProgressMinM ||
      !traversed_path_.T_odom_body())
    return false;
  return rejected_.all_farther_than(kProgressMinM, traversed_path_.T_odom_body()->translation());
}

/// On the way back that says nothing of what lies ahead, and it may be another place already. Who
/// does not know how it moves leaves it at that: it could be led anywhere, out of the mine, too.
void Mission::drive_failed(const std::string& reason) {
  if (limits_.is_unmeasured()) {
    end(MissionOutcome::kStranded, "it does not know any more where it is: " + reason);
    return;
  }
  if (backing_off_) {
    path_back_failed_ = goal_kind_ != PlanGoal::Kind::kRoute;
    enter(Phase::kExplore, "it looks from where it got to: " + reason);
    return;
  }
  if (!is_returning() && is_beyond_rejections()) retry_policy_.note_progress();
  reject(0.0, reason, Evidence::kDriveFailed);
}

}  // namespace adit
