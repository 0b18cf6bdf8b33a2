// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Recovery of Mission when no path is found or a drive fails, and the last metre to home.
#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "procs/mission/mission.hpp"

namespace adit {
namespace {

constexpr double kBackOffMinM = 1.0;      // of traversed path behind the robot
constexpr double kBackOffBesideM = 1.2;   // from the nose to the centre of the vehicle
constexpr double kApproachMarginM = 0.3;  // before the place where paths end
constexpr double kObstacleDepthM = 1.0;   // beyond the reached place, where the obstacle may be
constexpr double kLeadsBackMinM = 0.1;    // of traversed path; the robot can go back along it
constexpr double kSharedMinM = 2.5;       // of the route with the traversed path
constexpr double kRejoinM = 6.0;          // at first
constexpr double kRejoinMaxM = 30.0;      // after several rejoins
constexpr double kRejoinViewM = 10.0;     // poses beyond the rejoin length that planning may reach
constexpr double kStartRadiusM = 0.3;     // distance travelled; the robot is still at home

using Action = Recovery::Action;
using Evidence = Recovery::Evidence;

}  // namespace

/// After a rejection: measures what the traversed path allows, lets Recovery choose, and acts.
void Mission::recover(const Recovery::Rejection& rejection) {
  const std::string& reason = rejection.reason;
  if (home_arrival_.is_near(localization_.T_odom_body())) {
    retry_near_home(reason);
    return;
  }
  if (rejection.evidence == Evidence::kNarrow) narrow_frontiers_.insert(phase_.frontier);
  if (recovery_.rejections() == 0) {
    if (localization_.T_odom_body())
      progress_.add_rejection(localization_.T_odom_body()->translation());
  } else if (!limits_.is_unmeasured()) {
    // After a power loss the map may estimate odom only roughly until the robot moves, and without
    // the traversed path it cannot move. It stands where it stopped, and the guard protects it.
    localization_.anchor_to_estimate();
  }
  switch (recovery_.choose(rejection, recovery_options(rejection.reached_m))) {
    case Action::kScanBeside:
      return back_off(kBackOffBesideM, reason);
    case Action::kApproach:
      return approach(rejection.reached_m, reason);
    case Action::kScanOtherLaser:
      return request_scan(other(phase_.laser), "scanning with the other laser: " + reason);
    case Action::kBackOff:
      return back_off(recovery_.back_offs() * params_.back_off_m, reason);
    case Action::kRejoin:
      return rejoin(*rejoin_length_m(), reason);
    case Action::kRescan:
      return enter(Phase::kExplore, "scanning again: " + reason);
    case Action::kAbandon:
      return abandon_target();
  }
}

/// A route home that leaves the traversed path before the obstacle is a short cut: nothing is lost
/// without it, unless exploration has no other path.
Recovery::Options Mission::recovery_options(double reached_m) const {
  const TraversedPath& path = localization_.traversed_path();
  Recovery::Options options;
  options.can_back_off = path.back_length_m(params_.back_off_m) > kBackOffMinM;
  options.is_short_cut_home =
      is_returning() && !homeward_progress_.is_blocked() && path_leads_back() &&
      path.shared_length_m(target_.route_odom) < reached_m + kObstacleDepthM;
  options.can_rejoin = !options.is_short_cut_home && rejoin_length_m().has_value();
  return options;
}

void Mission::begin(Maneuver maneuver, const std::string& reason) {
  maneuver_ = std::move(maneuver);
  ++phase_.goal_id;
  enter(Phase::kPlan, reason);
}

void Mission::approach(double reached_m, const std::string& reason) {
  begin(Approach{reached_m - kApproachMarginM}, "driving nearer to scan from there: " + reason);
}

void Mission::back_off(double distance_m, const std::string& reason) {
  const auto kind = retracing_.failed ? PlanGoal::Kind::kRoute : PlanGoal::Kind::kRetrace;
  begin(BackOff{kind, distance_m, localization_.traversed_path().back(distance_m),
                approach_of(maneuver_)},
        "backing off to scan from another viewpoint: " + reason);
}

/// Planning leads onto the traversed path over observed ground. Before the first scan in a new odom
/// frame no ground is observed, so the path is retraced pose by pose.
void Mission::rejoin(double length_m, const std::string& reason) {
  ++retracing_.rejoins;
  const bool has_terrain = inputs_.terrain_utime >= localization_.odom_epoch_utime();
  const auto kind = has_terrain ? PlanGoal::Kind::kRejoin : PlanGoal::Kind::kRetrace;
  begin(Rejoin{kind, length_m,
               localization_.traversed_path().poses_back_within(length_m + kRejoinViewM),
               approach_of(maneuver_)},
        "resuming along the traversed path: " + reason);
}

bool Mission::path_leads_back() const {
  return localization_.traversed_path().back_length_m(kBackOffMinM) > kLeadsBackMinM;
}

/// Along the traversed path; empty if it does not lead to the target. On the return home it always
/// does, if by a detour; the length grows with the number of rejoins.
std::optional<double> Mission::rejoin_length_m() const {
  if (retracing_.failed) return std::nullopt;
  if (phase_.returning_home) {
    if (!path_leads_back()) return std::nullopt;
    return std::min(kRejoinM * (1 + retracing_.rejoins / 2), kRejoinMaxM);
  }
  const double shared_m = localization_.traversed_path().shared_length_m(target_.route_odom);
  if (shared_m < kSharedMinM) return std::nullopt;
  return std::min(shared_m, kRejoinM);
}

/// Reports a verdict on the target to exploration, unless it is straight ahead of the robot: then
/// exploration did not choose it.
void Mission::abandon_target() {
  const std::string evidence = recovery_.evidence();
  const bool unconfirmed = recovery_.is_uncertain() || narrow_frontiers_.contains(phase_.frontier);
  const double reached_m = recovery_.reached_m();
  recovery_.reset();
  if (target_.is_straight_ahead) {
    note_failed_try(evidence);
    return;
  }
  verdict_ = BlockedVerdict{now_utime(), phase_.frontier.value_or(ExplorationDecision::kNoFrontier),
                            reached_m, evidence, unconfirmed};
  homeward_progress_.mark_blocked();
  if (!phase_.frontier && ++failed_tries_ > params_.failed_tries_max) {
    end(MissionOutcome::kStranded, "no path onward was found: " + evidence);
    return;
  }
  enter(Phase::kExplore,
        (unconfirmed ? "no path was found: " : "the path is blocked: ") + evidence);
}

/// Near home, backing off would cost metres to gain decimetres.
void Mission::retry_near_home(const std::string& reason) {
  if (home_arrival_.count_try()) {
    end_near_home(reason);
  } else {
    request_scan(other(phase_.laser), "close to home, scanning with the other laser: " + reason);
  }
}

void Mission::end_near_home(const std::string& reason) {
  end(MissionOutcome::kHome,
      fmt::format("the robot is at home, {:.2f} m from the start, and gets no nearer: {}",
                  home_arrival_.distance_m(*localization_.T_odom_body()), reason));
}

void Mission::note_progress() {
  recovery_.reset();
  retracing_.rejoins = 0;
  failed_tries_ = 0;
}

/// A try without a target of exploration has failed.
void Mission::note_failed_try(const std::string& reason) {
  ++failed_tries_;
  if (failed_tries_ > params_.failed_tries_max) {
    const bool never_left = localization_.traversed_path().distance_travelled_m() < kStartRadiusM;
    end(never_left ? MissionOutcome::kHome : MissionOutcome::kStranded,
        (never_left ? "no path into the mine was found: " : "no path onward was found: ") + reason);
  } else if (phase_.returning_home && localization_.has_correction() && rejoin_length_m()) {
    rejoin(*rejoin_length_m(), "exploration found no route (" + reason + ")");
  } else {
    scan_straight_ahead("exploration found no route (" + reason + "): scanning straight ahead");
  }
}

}  // namespace adit
