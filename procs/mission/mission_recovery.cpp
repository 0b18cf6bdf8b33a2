// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Recovery of Mission when no path is found or a drive fails, and the last metre to home.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "procs/mission/mission.hpp"

namespace adit {
namespace {

constexpr double kWellKnown = 0.5;       // share of the allowed uncertainty of the pose at home
constexpr double kBackOffBesideM = 1.2;  // from the nose to the centre of the vehicle
// Before the place where paths end: the steepest beams reach the ground so far ahead of the nose.
constexpr double kApproachMarginM = 1.0;
// Longer than the robot backs off: a path from there to the same obstacle is no progress.
constexpr double kPathToRejectionM = 8.0;
constexpr double kObstacleDepthM = 1.0;  // beyond the reached place, where the obstacle may be
// On steeper ground terrain of earlier scans may stand up as an obstacle: its place and its height
// have errors that the slope couples [m/m].
constexpr double kSlopeReliable = 0.15;
constexpr int kTriesBeforeWithdrawal = 2;
constexpr double kWithdrawalM = 1.0;     // on the return, for each failed try,
constexpr double kWithdrawalMaxM = 6.0;  // at most
constexpr double kMatchAtHomeM = 5.0;    // and back: the length of two local maps
constexpr double kStartUnmeasuredM = 2.0;
constexpr double kUnlevelledMaxM = 5.0;  // distance travelled with unknown roll and pitch
constexpr double kUnknownHomeM = 20.0;   // an uncertainty that leaves other tunnels possible

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
  if (recovery_.rejections() == 0) {
    progress_.add_rejection(localization_.traversed_path().recent(kPathToRejectionM));
  } else if (!limits_.is_unmeasured()) {
    // After a power loss the map may estimate odom only roughly until the robot moves, and without
    // the traversed path it cannot move. It stands where it stopped, and the guard protects it.
    localization_.anchor_to_estimate();
  }
  switch (recovery_.choose(rejection, recovery_options(rejection.reached_m))) {
    case Action::kScanBeside:
      return back_off(kBackOffBesideM, reason);
    case Action::kApproach:
      return begin(Approach{rejection.reached_m - kApproachMarginM},
                   "driving nearer to scan from there: " + reason);
    case Action::kScanOtherLaser:
      return request_scan(other_laser(), "scanning with the other laser: " + reason);
    case Action::kBackOff:
      return back_off(recovery_.back_offs() * params_.back_off_m, reason);
    case Action::kRejoin:
      return rejoin(reason);
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
  options.can_back_off = Retracing::can_back_off(path, params_.back_off_m);
  options.is_short_cut_home =
      is_returning() && !homeward_progress_.is_blocked() && Retracing::leads_back(path) &&
      path.shared_length_m(target_.route_odom) < reached_m + kObstacleDepthM;
  options.has_other_laser = params_.lasers.has_rear();
  options.can_rejoin = !options.is_short_cut_home && rejoin_length_m().has_value();
  return options;
}

void Mission::begin(Maneuver maneuver, const std::string& reason) {
  maneuver_ = std::move(maneuver);
  ++phase_.goal_id;
  enter(Phase::kPlan, reason);
}

void Mission::back_off(double distance_m, const std::string& reason) {
  begin(retracing_.back_off(localization_.traversed_path(), distance_m, maneuver_),
        "backing off to scan from another viewpoint: " + reason);
}

void Mission::rejoin(const std::string& reason) {
  const bool has_terrain = inputs_.terrain_utime >= localization_.odom_epoch_utime();
  begin(
      retracing_.rejoin(localization_.traversed_path(), *rejoin_length_m(), has_terrain, maneuver_),
      "resuming along the traversed path: " + reason);
}

std::optional<double> Mission::rejoin_length_m() const {
  return retracing_.rejoin_length_m(localization_.traversed_path(), target_.route_odom,
                                    phase_.returning_home);
}

/// Reports a verdict on the target to exploration, unless it is straight ahead of the robot: then
/// exploration did not choose it. No planned path was found either: the traversed path may be tried
/// again after a failed drive on it.
void Mission::abandon_target() {
  retracing_.forget_failed_drive();
  const std::string evidence = recovery_.evidence();
  const bool unconfirmed = recovery_.is_uncertain() || slope_ > kSlopeReliable;
  const double reached_m = recovery_.reached_m();
  recovery_.reset();
  if (target_.is_straight_ahead) {
    note_failed_try(evidence);
    return;
  }
  if (homeward_detour_.is_active()) {  // no route of exploration: no verdict
    homeward_detour_.end();
    enter(Phase::kExplore, "the traversed path is blocked too: " + evidence);
    return;
  }
  verdict_ = BlockedVerdict{clock_.utime().value_or(0),
                            phase_.frontier.value_or(ExplorationDecision::kNoFrontier), reached_m,
                            evidence, unconfirmed};
  homeward_progress_.mark_blocked();
  if (!phase_.frontier && ++failed_tries_ > params_.failed_tries_max) {
    end(MissionOutcome::kStranded, "no path onward was found: " + evidence);
    return;
  }
  if (is_returning() && !phase_.frontier)
    homeward_detour_.note_blocked(localization_.traversed_path());
  if (!homeward_detour_.is_active() && withdraw(evidence)) return;
  enter(Phase::kExplore,
        (unconfirmed ? "no path was found: " : "the path is blocked: ") + evidence);
}

/// On the return the traversed path leads on, through the place where the robot is stuck. It has
/// come there from the other side, and from some metres back it approaches differently. False if
/// the target is a frontier, which it may leave.
bool Mission::withdraw(const std::string& reason) {
  if (phase_.frontier || !is_returning() || failed_tries_ < kTriesBeforeWithdrawal) return false;
  auto withdrawal = Retracing::withdrawal(localization_.traversed_path(),
                                          std::min(failed_tries_ * kWithdrawalM, kWithdrawalMaxM));
  if (!withdrawal) return false;
  begin(std::move(*withdrawal), "back into the mine, to approach again: " + reason);
  return true;
}

/// Near home, backing off would cost metres to gain decimetres.
void Mission::retry_near_home(const std::string& reason) {
  if (home_arrival_.count_try()) {
    end_near_home(reason);
  } else {
    const bool has_rear = params_.lasers.has_rear();
    request_scan(other_laser(), fmt::format("close to home, scanning {}: {}",
                                            has_rear ? "with the other laser" : "again", reason));
  }
}

void Mission::end_near_home(const std::string& reason) {
  end_at_home(fmt::format("{:.2f} m from the start, it gets no nearer: {}",
                          home_arrival_.distance_m(*localization_.T_odom_body()), reason));
}

/// Where the pose relative to home is not well known, the robot stands for some seconds, in which
/// mapping matches what it sees. If that does not suffice it takes a 3D scan, which mapping matches
/// with those of the start. If the pose is still too uncertain it drives along the traversed path
/// and comes home again: mapping then matches new local maps with those of the start. Without an
/// IMU a slope displaces the map by more than it states, and nothing measures the slope.
void Mission::end_at_home(const std::string& reason) {
  const std::optional<double> uncertainty_m = localization_.home_uncertainty_m();
  if (!uncertainty_m) return end(MissionOutcome::kHome, "the robot is at home: " + reason);
  const bool is_sure = *uncertainty_m <= params_.home_uncertainty_max_m && !home_unknown();
  const bool is_well_known =
      is_sure && *uncertainty_m <= kWellKnown * params_.home_uncertainty_max_m;
  if (!is_well_known && !looks_at_home_) {
    looks_at_home_ = true;
    enter(Phase::kExplore,
          fmt::format("at home by the estimate, but the pose has an uncertainty of {:.2f} m (95 "
                      "%): looking from standstill: {}",
                      *uncertainty_m, reason));
    return;
  }
  looks_at_home_ = false;
  if (!is_well_known && !scanned_at_home_) {
    scans_at_home_ = scanned_at_home_ = true;
    scan_tries_ = 0;
    request_scan(laser_as_at_start(),
                 fmt::format("at home by the estimate, but the pose has an uncertainty of {:.2f} m "
                             "(95 %): a 3D scan to compare with that of the start: {}",
                             *uncertainty_m, reason));
    return;
  }
  scanned_at_home_ = false;
  if (!is_sure && can_match_at_home(*uncertainty_m)) {
    home_uncertainties_m_.push_back(*uncertainty_m);
    begin(BackOff{PlanGoal::Kind::kRetrace, kMatchAtHomeM,
                  localization_.traversed_path().recent(kMatchAtHomeM), std::nullopt},
          fmt::format("at home by the estimate, but the pose has an uncertainty of {:.2f} m (95 "
                      "%): matching again: {}",
                      *uncertainty_m, reason));
    return;
  }
  const double within_m = localization_.distance_from_home_m().value_or(0.0) + *uncertainty_m;
  if (home_unknown() || within_m > kUnknownHomeM) {
    const std::string why = home_unknown().value_or(
        fmt::format("the pose has an uncertainty of {:.0f} m (95 %)", *uncertainty_m));
    end(MissionOutcome::kHomeUncertain,
        fmt::format("the robot does not know where home is: {}: {}", why, reason));
    return;
  }
  phase_.home_within_m = within_m;
  if (unlevelled_m_ > kUnlevelledMaxM) {
    end(MissionOutcome::kHomeUncertain,
        fmt::format("at home by its own estimate, not sure: within {:.2f} m (95 %) if the ground "
                    "was level, as roll and pitch were unknown for {:.0f} m: {}",
                    within_m, unlevelled_m_, reason));
    return;
  }
  end(is_sure ? MissionOutcome::kHome : MissionOutcome::kHomeUncertain,
      fmt::format("{} within {:.2f} m (95 %): {}",
                  is_sure ? "the robot is at home," : "at home by its own estimate, not sure:",
                  within_m, reason));
}

/// The one that looks into the mine, as the front laser did at the start.
LaserId Mission::laser_as_at_start() const {
  const std::optional<Pose2>& T_odom_body = localization_.T_odom_body();
  const bool turned = T_odom_body && std::cos(T_odom_body->theta) < 0.0;
  return turned && params_.lasers.has_rear() ? LaserId::kRear : LaserId::kFront;
}

/// Mapping has some seconds to match the 3D scan.
void Mission::end_scan_at_home(const std::string& reason) {
  looks_at_home_ = true;
  enter(Phase::kExplore, reason);
}

/// Where no sensor measures the motion, but the wheels have hardly rolled, the robot is at the
/// start within that distance, and each further drive would take it to a place that is less known.
/// False if it is farther away or that is unknown.
bool Mission::end_unmeasured_at_start(const std::string& reason) {
  const std::optional<double> within_m = rolled_.bound_m();
  if (!within_m || *within_m > kStartUnmeasuredM) return false;
  const bool is_sure = *within_m <= params_.home_uncertainty_max_m;
  phase_.home_within_m = *within_m;
  end(is_sure ? MissionOutcome::kHome : MissionOutcome::kHomeUncertain,
      fmt::format(
          "the wheels have rolled so little that the robot is within {:.2f} m of the start: "
          "{}",
          *within_m, reason));
  return true;
}

/// Not if it did not help before, and not where a limit of air, ground or map made the robot turn
/// around.
bool Mission::can_match_at_home(double uncertainty_m) const {
  const bool helped = home_uncertainties_m_.empty() || uncertainty_m < home_uncertainties_m_.back();
  return helped && std::ssize(home_uncertainties_m_) < params_.home_retries && !limits_.reason() &&
         phase_.remaining_m > 2.0 * kMatchAtHomeM &&
         localization_.traversed_path().distance_travelled_m() > kMatchAtHomeM;
}

void Mission::note_progress() {
  recovery_.reset();
  retracing_.note_progress();
  failed_tries_ = 0;
}

/// A try without a target of exploration has failed.
void Mission::note_failed_try(const std::string& reason) {
  ++failed_tries_;
  if (failed_tries_ > params_.failed_tries_max) {
    const bool never_left = localization_.traversed_path().distance_travelled_m() < kAtStartM;
    never_left ? end_at_home("no path into the mine was found: " + reason)
               : end(MissionOutcome::kStranded, "no path onward was found: " + reason);
  } else if (phase_.returning_home && localization_.has_correction() && rejoin_length_m()) {
    rejoin("exploration found no route (" + reason + ")");
  } else {
    scan_straight_ahead("exploration found no route (" + reason + "): scanning straight ahead");
  }
}

}  // namespace adit
