// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mission/mission.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "common/geometry/attitude.hpp"

namespace adit {
namespace {

constexpr double kExplorationTimeoutS = 300.0;  // it may restart, and wait for the map
constexpr double kLookS = 5.0;                  // mapping takes 2 s and reports each second
constexpr double kScanTimeoutS = 30.0;          // a sweep takes 8 s
constexpr double kPlanTimeoutS = 10.0;
constexpr double kDrivingTimeoutS = 3.0;
constexpr double kPathReceiptS = 2.0;   // until driving has received its path
constexpr int kIncompleteScansMax = 3;  // in a row; an incomplete scan is accepted then
constexpr double kScanAheadM = 10.0;    // length of a route straight ahead
constexpr double kPathMovedMaxM = 0.1;  // a terrain cell
constexpr double kFacingM = 2.5;        // distance of the route point that selects the laser
constexpr double kFacingHysteresisRad = 0.3;

using Evidence = Recovery::Evidence;

/// The laser that faces the route, with hysteresis in favour of the present one.
LaserId laser_facing(const std::vector<Eigen::Vector2d>& route_odom, const Pose2& T_odom_body,
                     LaserId present) {
  Eigen::Vector2d p_odom_ahead = route_odom.back();
  for (const Eigen::Vector2d& p_odom : route_odom) {
    if ((p_odom - T_odom_body.translation()).norm() < kFacingM) continue;
    p_odom_ahead = p_odom;
    break;
  }
  const Eigen::Vector2d p_body_ahead = T_odom_body.inverse() * p_odom_ahead;
  const double angle = std::abs(std::atan2(p_body_ahead.y(), p_body_ahead.x()));
  const double hysteresis =
      present == LaserId::kFront ? kFacingHysteresisRad : -kFacingHysteresisRad;
  return angle < std::numbers::pi / 2.0 + hysteresis ? LaserId::kFront : LaserId::kRear;
}

std::optional<std::int32_t> frontier_of(const ExplorationDecision& decision) {
  if (decision.frontier == ExplorationDecision::kNoFrontier) return std::nullopt;
  return decision.frontier;
}

bool is_active(Phase phase) { return phase != Phase::kPaused && phase != Phase::kEnded; }

Evidence evidence_of(const PlannedPath& path) {
  // Without a blocking cell, no ground was observed to block.
  if (path.outcome == PlanOutcome::kBlocked && !path.blocking.empty()) return Evidence::kObserved;
  return path.outcome == PlanOutcome::kNarrow ? Evidence::kNarrow : Evidence::kUnobserved;
}

/// The pose at a distance along a route, with the x axis along it. Empty without a segment there.
std::optional<Pose2> pose_along(const std::vector<Eigen::Vector2d>& route_odom, double distance_m) {
  for (std::size_t i = 1; i < route_odom.size(); ++i) {
    const Eigen::Vector2d leg = route_odom[i] - route_odom[i - 1];
    const double leg_m = leg.norm();
    if (leg_m > 0.0 && distance_m <= leg_m) {
      const Eigen::Vector2d p_odom = route_odom[i - 1] + std::max(distance_m, 0.0) / leg_m * leg;
      return Pose2{p_odom.x(), p_odom.y(), std::atan2(leg.y(), leg.x())};
    }
    distance_m -= leg_m;
  }
  return std::nullopt;
}

}  // namespace

void Mission::restore(const MissionPhase& last, std::int64_t start_utime,
                      std::vector<StoredPathPose> path, KnownMap known_map) {
  localization_.restore(last.utime, last.distance_travelled_m, std::move(path),
                        std::move(known_map));
  limits_.begin(last.distance_travelled_m);
  rolled_.invalidate();
  clock_.restore(start_utime);
  explore_id_ = last.sequence;  // exploration answers each id once
  return_is_final_ = last.returning_home && !last.frontier;
  phase_ = last;
  if (!is_active(last.phase)) return;
  phase_.utime = 0;
  phase_.phase = Phase::kWaiting;
  phase_.frontier.reset();
  phase_.remaining_m = 0.0;
  phase_.outcome = MissionOutcome::kInProgress;
  phase_.complete = false;
  if (last.phase != Phase::kWaiting) {
    phase_.reason = "the mission was interrupted after: " + last.reason;
  }
}

MissionRequests Mission::advance(std::int64_t utime) {
  set_time(utime);
  if (is_active(phase_.phase) && limits_.reason() && !return_is_final_) {
    turn_around(*limits_.reason());
    if (limits_.is_unmeasured()) end_unmeasured_at_start(*limits_.reason());
  }
  if (phase_.phase == Phase::kWaiting) wait_for_stages();
  MissionRequests requests;
  switch (phase_.phase) {
    case Phase::kExplore:
      requests.explore = explore();
      break;
    case Phase::kScan:
      requests.scan = scan();
      break;
    case Phase::kPlan:
      requests.goal = plan();
      break;
    case Phase::kExecute:
      execute();
      break;
    case Phase::kWaiting:
    case Phase::kPaused:
    case Phase::kEnded:
      break;
  }
  return requests;
}

void Mission::set_time(std::int64_t utime) {
  clock_.set_time(utime);
  phase_.utime = *clock_.phase_utime();
  phase_.distance_travelled_m = localization_.traversed_path().distance_travelled_m();
  phase_.remaining_m = limits_.remaining_m(clock_.mission_age_s(), phase_.distance_travelled_m);
}

/// Waits for poses and driving states, and after a reset of odom for the map correction.
void Mission::wait_for_stages() {
  if (phase_.sequence == 0 && !localization_.is_restored() && params_.start == "on_order") {
    enter(Phase::kPaused, "waiting for the order to start");
    return;
  }
  const auto driving_age_s = clock_.age_s(inputs_.driving_utime);
  const bool has_driving = inputs_.driving && driving_age_s && *driving_age_s < kDrivingTimeoutS;
  if (!localization_.has_recent_pose(*clock_.utime()) || !has_driving) return;
  if (localization_.is_waiting_for_correction() &&
      clock_.phase_age_s() < params_.relocalization_wait_s)
    return;
  enter(Phase::kExplore,
        localization_.is_restored() ? "the mission resumes" : "the stages are ready");
}

std::optional<ExploreRequest> Mission::explore() {
  if (localization_.is_waiting_for_correction()) {
    scan_straight_ahead("no map correction: scanning straight ahead to recognise a place");
    return std::nullopt;
  }
  if (clock_.phase_age_s() > kExplorationTimeoutS) {
    note_failed_try("exploration does not answer");
    return std::nullopt;
  }
  if (looks_at_home_ && clock_.phase_age_s() < kLookS) return std::nullopt;
  if (!clock_.is_request_due()) return std::nullopt;
  return ExploreRequest{*clock_.utime(), explore_id_, phase_.remaining_m, return_is_final_,
                        verdict_};
}

std::optional<ScanRequest> Mission::scan() {
  if (clock_.phase_age_s() > kScanTimeoutS) {
    if (scans_at_home_) {
      end_scan_at_home("no 3D scan arrives, looking from standstill");
      return std::nullopt;
    }
    if (++scan_tries_ > params_.failed_tries_max) {
      end(MissionOutcome::kStranded, "no 3D scan arrives");
      return std::nullopt;
    }
    request_scan(scan_tries_ % 2 == 0 ? other_laser() : phase_.laser,
                 "no 3D scan arrived: scanning again");
    return std::nullopt;
  }
  if (!clock_.is_request_due()) return std::nullopt;
  return ScanRequest{*clock_.utime(), phase_.goal_id, phase_.laser};
}

std::optional<PlanGoal> Mission::plan() {
  if (clock_.phase_age_s() > kPlanTimeoutS) {
    if (target_.route_odom.empty()) {  // a rejoin right after a restart
      enter(Phase::kExplore, "planning did not answer: exploring again");
    } else {
      request_scan(phase_.laser, "planning did not answer: scanning again");
    }
    return std::nullopt;
  }
  if (!clock_.is_request_due()) return std::nullopt;
  PlanGoal goal = goal_of(maneuver_, {target_.route_odom, home_arrival_.is_end_of_route()});
  goal.utime = *clock_.utime();
  goal.id = phase_.goal_id;
  return goal;
}

/// Arrival and failure are handled when DRIVING_STATE arrives.
void Mission::execute() {
  if (clock_.age_s(inputs_.driving_utime) > kDrivingTimeoutS) {
    recover({Evidence::kDriveFailed, 0.0, "Driving timed out."});
  }
}

void Mission::add_exploration(const ExplorationReport& report) {
  if (phase_.phase == Phase::kExplore && report.request == explore_id_) evaluate(report);
}

void Mission::evaluate(const ExplorationReport& report) {
  using Kind = ExplorationDecision::Kind;
  const ExplorationDecision& decision = report.decision;
  phase_.complete = decision.complete;
  if (decision.kind == Kind::kStay) {
    const bool is_first_odom = !localization_.is_restored() && !localization_.odom_was_reset();
    if (report.revision == 0 && is_first_odom) {
      scan_straight_ahead("no map yet: scanning straight ahead");
    } else if (clock_.phase_age_s() > params_.exploration_wait_s) {
      note_failed_try(decision.reason);
    }
    return;
  }
  verdict_.reset();
  if (decision.kind == Kind::kDone) {
    end_at_home(decision.reason);
    return;
  }
  set_target(report);
  if (home_arrival_.is_near(localization_.T_odom_body()) && home_arrival_.count_try()) {
    end_near_home(decision.reason);
    return;
  }
  if (const auto detour = detour_of(report)) {
    home_arrival_.set_route(*detour);
    scan_along(detour->route_odom, detour->decision.reason);
    return;
  }
  scan_along(report.route_odom, decision.reason);
}

/// The route home along the traversed path in place of that of exploration, see HomewardDetour.
std::optional<ExplorationReport> Mission::detour_of(const ExplorationReport& report) {
  if (!homeward_detour_.is_active() || !is_returning()) return std::nullopt;
  const TraversedPath& path = localization_.traversed_path();
  auto route_odom = homeward_detour_.route_odom(path);
  if (!route_odom) {
    homeward_detour_.end();
    recovery_.reset();
    failed_tries_ = 0;
    return std::nullopt;
  }
  ExplorationReport detour = report;
  detour.route_odom = std::move(*route_odom);
  detour.decision.reason =
      fmt::format("routes home were blocked: {:.0f} m along the traversed path: {}",
                  homeward_detour_.left_m(path), report.decision.reason);
  return detour;
}

void Mission::set_target(const ExplorationReport& report) {
  const ExplorationDecision& decision = report.decision;
  const bool home = decision.kind == ExplorationDecision::Kind::kHome;
  if (home && !phase_.returning_home) phase_.return_home_reason = decision.reason;
  if (!home && !return_is_final_) phase_.return_home_reason.clear();
  phase_.returning_home = home || return_is_final_;
  if (!home) scanned_at_home_ = false;
  phase_.frontier = frontier_of(decision);
  target_.is_straight_ahead = false;
  if (recovery_.set_target(phase_.frontier, home)) {
    retracing_.note_progress();
    homeward_progress_.reset();
    homeward_detour_.reset();
  }
  if (home && homeward_progress_.add(decision.distance_m)) note_progress();
  home_arrival_.set_route(report);
}

void Mission::scan_along(std::vector<Eigen::Vector2d> route_odom, const std::string& reason) {
  if (route_odom.size() < 2) {
    note_failed_try("the route is empty");
    return;
  }
  target_.route_odom = std::move(route_odom);
  scan_tries_ = 0;
  const auto& T_odom_body = localization_.T_odom_body();
  const LaserId laser = T_odom_body && params_.lasers.has_rear()
                            ? laser_facing(target_.route_odom, *T_odom_body, phase_.laser)
                            : phase_.laser;
  const double unscanned_m =
      localization_.traversed_path().distance_travelled_m() - inputs_.terrain_distance_m;
  target_.is_known = transit(0.0).has_value();
  if (auto known = transit(unscanned_m)) {
    phase_.laser = laser;
    begin(std::move(*known), reason + ", where the robot has driven before");
  } else {
    request_scan(laser, reason);
  }
}

/// Where the robot has driven before it needs no scan, unless one is due or a rejection must be
/// investigated. `unscanned_m`: driven since the last scan. Backwards a robot without a rear laser
/// would drive blind: it plans a path to turn round, and retraces only if there is none.
std::optional<Rejoin> Mission::transit(double unscanned_m) const {
  const bool has_terrain = inputs_.terrain_utime >= localization_.odom_epoch_utime();
  if (target_.is_straight_ahead || recovery_.rejections() > 0 || !has_terrain) return std::nullopt;
  return retracing_.transit(localization_.traversed_path(), target_.route_odom, unscanned_m,
                            home_arrival_.is_end_of_route(), params_.lasers.sees_behind());
}

/// Along the x axis of the body; in the opposite direction after an odd number of failed tries.
void Mission::scan_straight_ahead(const std::string& reason) {
  if (!localization_.T_odom_body()) return;
  const Pose2& T_odom_body = *localization_.T_odom_body();
  phase_.frontier.reset();
  target_.is_straight_ahead = true;
  home_arrival_.clear();
  recovery_.set_target(std::nullopt, phase_.returning_home);
  const double ahead_m = failed_tries_ % 2 == 1 ? -kScanAheadM : kScanAheadM;
  scan_along({T_odom_body.translation(), T_odom_body * Eigen::Vector2d(ahead_m, 0.0)}, reason);
}

/// A robot with one laser scans with it again.
LaserId Mission::other_laser() const {
  return params_.lasers.has_rear() ? other(phase_.laser) : LaserId::kFront;
}

void Mission::request_scan(LaserId laser, const std::string& reason) {
  phase_.laser = laser;
  ++phase_.goal_id;
  enter(Phase::kScan, reason);
}

/// A scan is incomplete if the robot moved or the laser timed out. It is repeated.
void Mission::add_cloud(std::int32_t id, bool complete) {
  if (phase_.phase != Phase::kScan || id != phase_.goal_id || complete) return;
  if (++scan_tries_ <= kIncompleteScansMax)
    request_scan(phase_.laser, "the 3D scan is incomplete: scanning again");
}

void Mission::add_terrain(std::int64_t utime, std::int32_t id) {
  if (phase_.phase != Phase::kScan || id != phase_.goal_id) return;
  ++phase_.scans;
  inputs_.terrain_utime = utime;
  inputs_.terrain_distance_m = localization_.traversed_path().distance_travelled_m();
  if (scans_at_home_) {
    end_scan_at_home("the 3D scan is ready, comparing it with that of the start");
    return;
  }
  enter(Phase::kPlan, "the 3D scan is ready");
  if (auto known = known_path()) maneuver_ = std::move(*known);
}

/// After a scan: over its terrain first, then along driven ground. A path beside that would end the
/// transit, and each further path need a scan.
std::optional<Rejoin> Mission::known_path() const {
  auto known = target_.is_known ? transit(0.0) : std::nullopt;
  if (known) {
    known->kind = PlanGoal::Kind::kRejoin;
    known->is_short_cut = true;
  }
  if (known || target_.is_straight_ahead || recovery_.rejections() > 0) return known;
  return retracing_.join(localization_.traversed_path(), target_.route_odom,
                         params_.lasers.sees_behind(), params_.vehicle.is_symmetric());
}

void Mission::add_path(const PlannedPath& path) {
  if (phase_.phase != Phase::kPlan || path.id != phase_.goal_id) return;
  const bool rests_on_old_scan = path.utime < inputs_.terrain_utime;
  if (rests_on_old_scan && !is_off_route(maneuver_)) return;
  evaluate(path);
}

void Mission::evaluate(const PlannedPath& path) {
  if (path.outcome == PlanOutcome::kFound) {
    recovery_.narrow_passages().add_path(path.points);
    progress_.begin_drive(localization_.traversed_path().distance_travelled_m());
    inputs_.driving_utime = clock_.utime();
    enter(Phase::kExecute, path.reason);
  } else if (auto planned = planned_instead_of_retraced(maneuver_)) {
    begin(std::move(*planned), "backing off by a planned path: " + path.reason);
  } else if (const auto* known = std::get_if<Rejoin>(&maneuver_); known && known->is_short_cut) {
    begin(FollowRoute{}, "no path onto ground that it has driven: " + path.reason);
  } else if (is_off_route(maneuver_)) {
    retracing_.note_drive(true);
    recover(
        {Evidence::kDriveFailed, recovery_.reached_m(), "No path back was found: " + path.reason});
  } else if (std::holds_alternative<Approach>(maneuver_)) {
    maneuver_ = FollowRoute{};
    recover({Evidence::kUnobserved, path.reached_m, "No path nearer was found: " + path.reason});
  } else {
    recover({evidence_of(path), path.reached_m, path.reason,
             pose_along(target_.route_odom, path.reached_m)});
  }
}

void Mission::add_driving(const DrivingState& state) {
  inputs_.driving = state;
  inputs_.driving_utime = clock_.utime();
  if (phase_.phase == Phase::kExecute) evaluate(state);
}

void Mission::evaluate(const DrivingState& state) {
  using Kind = DrivingState::Kind;
  if (state.path_id != phase_.goal_id || state.kind == Kind::kIdle) {
    if (clock_.phase_age_s() > kPathReceiptS) enter(Phase::kExplore, "driving lost its path");
  } else if (state.kind == Kind::kArrived) {
    handle_arrival();
  } else if (state.kind == Kind::kFailed) {
    handle_failed_drive("Driving failed: " + state.reason + ".");
  }
}

void Mission::handle_arrival() {
  retracing_.note_drive(false);
  if (!leads_away(maneuver_)) {
    if (!is_returning() && progress_.is_beyond_rejections(localization_.traversed_path()))
      note_progress();
    const auto& T_odom_body = localization_.T_odom_body();
    if (T_odom_body && progress_.add_path_end(T_odom_body->translation())) {
      recover({Evidence::kDriveFailed, 0.0, "The last paths all ended at the same place."});
      return;
    }
  }
  enter(Phase::kExplore, "the robot reached the end of the path");
}

/// A failed drive along the traversed path is no evidence about the ground ahead, and the robot may
/// be at another place. With unmeasured motion the mission ends: the robot could leave the mine.
void Mission::handle_failed_drive(const std::string& reason) {
  if (limits_.is_unmeasured()) {
    if (end_unmeasured_at_start(reason)) return;
    end(MissionOutcome::kStranded, "the pose of the robot is unknown: " + reason);
    return;
  }
  if (is_off_route(maneuver_)) {
    retracing_.note_drive(uses_traversed_path(maneuver_));
    recovery_.note_missed_viewpoint();
    enter(Phase::kExplore, "scanning from where the drive ended: " + reason);
    return;
  }
  if (!is_returning() && progress_.is_beyond_rejections(localization_.traversed_path()))
    recovery_.reset();
  recover({Evidence::kDriveFailed, 0.0, reason});
}

std::optional<StoredPathPose> Mission::add_pose(std::int64_t utime, const Pose2& T_odom_body,
                                                double z_odom_m) {
  recovery_.narrow_passages().add_pose(T_odom_body);
  return localization_.add_pose(utime, T_odom_body, z_odom_m);
}

/// After a reset of odom, plans in the previous odom frame are invalid.
void Mission::add_match(const ScanMatch& match) {
  using OdomChange = MissionLocalization::OdomChange;
  const bool drives = phase_.phase == Phase::kExecute && inputs_.driving &&
                      inputs_.driving->kind == DrivingState::Kind::kDriving;
  limits_.add(match, drives);
  slope_ = match.attitude ? ground_slope(*match.attitude).norm() : 0.0;
  if (!match.attitude || match.attitude_from_ground)
    unlevelled_m_ += match.T_reference_body.translation().norm();
  const OdomChange change = localization_.set_odom_epoch(match.odom_epoch_utime);
  if (change == OdomChange::kNone) return;
  progress_.reset_odom();
  recovery_.narrow_passages().reset_odom();
  home_arrival_.clear();
  retracing_.reset();
  homeward_detour_.reset();
  if (!is_active(phase_.phase)) return;
  if (change == OdomChange::kResetBeforeRestart && !return_is_final_ &&
      params_.after_power_loss == "home") {
    return_is_final_ = phase_.returning_home = true;
    phase_.return_home_reason = "the computer was off";
  }
  enter(Phase::kWaiting, "odom was reset: waiting for the map correction");
}

/// The path along the traversed path is where that was in odom when it began: where the map has
/// moved that since, it no longer leads over the ground that the robot drove.
void Mission::add_correction(const MapCorrection& correction) {
  limits_.add(correction);
  path_moved_m_ += localization_.add_correction(correction);
  const bool follows_old_ground =
      std::holds_alternative<Rejoin>(maneuver_) && uses_traversed_path(maneuver_);
  if (phase_.phase != Phase::kExecute || !follows_old_ground || path_moved_m_ < kPathMovedMaxM)
    return;
  enter(Phase::kExplore,
        fmt::format("the map has moved the traversed path by {:.2f} m", path_moved_m_));
}

void Mission::add_vehicle_state(const VehicleState& state) {
  limits_.add(state);
  rolled_.add(state);
}

void Mission::add_order(const MissionOrder& order) {
  using Order = MissionOrder::Kind;
  if (phase_.phase == Phase::kEnded) return;
  const bool paused = phase_.phase == Phase::kPaused;
  if (order.kind == Order::kPause && !paused) {
    enter(Phase::kPaused, "by order");
  } else if (order.kind == Order::kResume && paused) {
    enter(Phase::kWaiting, "resumed by order");
  } else if (order.kind == Order::kReturnHome && !return_is_final_) {
    turn_around("by order");
  } else if (order.kind == Order::kStop) {
    end(MissionOutcome::kStopped, "by order");
  }
}

void Mission::enter(Phase phase, const std::string& reason) {
  clock_.begin_phase();
  phase_.utime = clock_.utime().value_or(phase_.utime);
  ++phase_.sequence;
  phase_.phase = phase;
  phase_.reason = reason;
  if (phase == Phase::kExplore) ++explore_id_;
  if (phase != Phase::kExplore) looks_at_home_ = false;
  if (phase != Phase::kScan) scans_at_home_ = false;
  if (phase != Phase::kPlan && phase != Phase::kExecute) maneuver_ = FollowRoute{};
  if (phase != Phase::kExecute) path_moved_m_ = 0.0;
}

void Mission::end(MissionOutcome outcome, const std::string& reason) {
  phase_.outcome = outcome;
  enter(Phase::kEnded, reason);
}

void Mission::turn_around(const std::string& reason) {
  return_is_final_ = true;
  phase_.returning_home = true;
  phase_.return_home_reason = reason;
  phase_.frontier.reset();  // in the journal, this marks the return as final
  verdict_.reset();
  enter(Phase::kExplore, "the robot turns around: " + reason);
}

bool Mission::is_returning() const { return phase_.returning_home && !target_.is_straight_ahead; }

}  // namespace adit
