// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/driving/driving.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "common/sensing/obstacle_points.hpp"
#include "common/sensing/seconds.hpp"

namespace adit {
namespace {

constexpr double kCurvatureWindowM = 0.05;  // half the window of the curvature at a point
constexpr double kPathLengthMaxM = 1000.0;  // ten times the range of any scan
constexpr double kStepMaxS = 0.2;           // maximum duration of a command

// An error of the steering displaces the vehicle by its curvature times the square of the response:
// where walls are near, and the robot slow, half of it.
constexpr double kResponseShareMin = 0.7;
constexpr std::int64_t kScanPoseMaxUs = 200'000;  // between a scan and the newest pose
constexpr double kLevelRad =
    0.01;  // tilt of a laser, beyond which it measures another part of the walls

double response_share(double clearance_m, double clearance_full_m) {
  return std::clamp(clearance_m / clearance_full_m, kResponseShareMin, 1.0);
}

}  // namespace

Driving::Driving(const DrivingParams& params)
    : params_(params),
      steered_(params.vehicle),
      filter_(params.smoothing_s),
      permission_(params.localization),
      monitor_(params.progress),
      ramp_(params.speed.acceleration_m_s2, params.steering.rate_1_m_s),
      centring_(params.vehicle, params.centring) {
  state_.reason = "no path received yet";
}

void Driving::follow(const PlannedPath& path) {
  state_ = {state_.utime, path.id, Kind::kIdle, path.reason, 0.0, 0.0, {}};
  if (path.outcome != PlanOutcome::kFound || path.points.empty()) return;
  state_.reason = "the path exceeds the maximum length";
  if (!(path_length_m(path) <= kPathLengthMaxM)) return;
  state_.kind = Kind::kDriving;
  state_.reason.clear();
  std::vector<PathRun> runs = split_into_runs(path.points, steered_);
  for (PathRun& run : runs) {
    run = blended(run, params_.steering.blend_m, params_.steering.blend_wide_m,
                  params_.speed.clearance_full_m);
  }
  progress_.emplace(std::move(runs));
  monitor_.reset();
  hold_steering_.reset();
  state_.remaining_m = progress_->remaining_m();
  begin_run();
}

void Driving::begin_run() {
  profile_.emplace(progress_->run(), params_.speed, params_.vehicle.speed_max_m_s,
                   params_.steering.rate_1_m_s);
  centring_.reset();
}

void Driving::add_pose(std::int64_t utime, const Pose2& T_odom_body, const Attitude& attitude) {
  filter_.add(utime, steered_.pose(T_odom_body));
  drift_.add(steered_.pose(T_odom_body));
  monitor_.add_pose(utime, T_odom_body, attitude);
  attitude_ = attitude;
}

void Driving::add_tilt(LaserId laser, const TiltReading& reading) {
  tilt_rad_.at(static_cast<std::size_t>(laser)) = reading.angle_rad;
}

void Driving::add_scan(LaserId laser, const LaserScan& scan) {
  const double tilt_rad = tilt_rad_.at(static_cast<std::size_t>(laser));
  const bool has_pose = filter_.utime() && std::abs(scan.utime - *filter_.utime()) < kScanPoseMaxUs;
  if (!is_active() || !has_pose || std::abs(tilt_rad) > kLevelRad) return;
  const LaserMount& mount = laser == LaserId::kFront ? params_.lasers.front : params_.lasers.rear;
  LaserPoints points =
      project_scan(scan, mount, tilt_rad, attitude_.up_body(),
                   {.min_m = params_.vehicle.step_max_m, .max_m = params_.vehicle.height_m});
  const Pose2 T_odom_body = steered_.body(filter_.at(scan.utime));
  for (Eigen::Vector2d& p : points.p_body) p = T_odom_body * p;
  centring_.add(points.p_body, progress_->run(), progress_->s_m());
}

void Driving::add_match(const ScanMatch& match) {
  permission_.add_match(match);
  monitor_.add_match(match);
}

void Driving::add_state(const VehicleState& state) {
  permission_.add_state(state);
  monitor_.add_state(state);
}

void Driving::add_phase(const MissionPhase& phase, std::int64_t utime) {
  permission_.add_phase(phase, utime);
}

DriveOutput Driving::drive(std::int64_t utime) {
  const double seconds = seconds_to(utime);
  update_permission(utime);
  if (is_active()) update_progress(utime);
  if (is_active()) {
    move(seconds);
  } else {
    ramp_.stop(seconds);
    monitor_.reset_hold();
  }
  monitor_.add_drive(ramp_.speed_m_s() * seconds);
  filter_.set_motion(permission_.vehicle().speed_m_s(utime, ramp_.speed_m_s()),
                     ramp_.curvature_1_m());
  return {{utime, ramp_.speed_m_s(), steered_.curvature_of_origin(ramp_.curvature_1_m())}, state_};
}

double Driving::seconds_to(std::int64_t utime) {
  const std::int64_t since = utime_ ? utime - *utime_ : 0;
  utime_ = utime;
  state_.utime = utime;
  return std::clamp(seconds(since), 0.0, kStepMaxS);
}

void Driving::update_permission(std::int64_t utime) {
  if (state_.kind != Kind::kDriving && state_.kind != Kind::kWaiting) return;
  permission_.update(utime, filter_.utime(), state_.path_id);
  const auto& denial_reason = permission_.denial_reason();
  const auto& hold_reason = permission_.hold_reason();
  state_.kind = denial_reason || hold_reason ? Kind::kWaiting : Kind::kDriving;
  state_.reason = denial_reason.value_or(hold_reason.value_or(""));
}

/// A robot that is held is localized and continues to command its path.
bool Driving::is_active() const {
  return state_.kind == Kind::kDriving ||
         (state_.kind == Kind::kWaiting && permission_.hold_reason());
}

void Driving::update_progress(std::int64_t utime) {
  const auto reaction_us = std::llround(params_.reaction_s * 1e6);
  const Pose2 T_odom_steered = filter_.at(utime + reaction_us);
  progress_->advance(T_odom_steered);
  state_.progress_m = progress_->distance_travelled_m();
  state_.remaining_m = progress_->remaining_m();
  state_.error = progress_->error(T_odom_steered);
  hold_steering_.update(utime, state_.progress_m, permission_.hold_reason().has_value());
  target_curvature_1_m_ = target_curvature_1_m(T_odom_steered);
  const auto failure_reason =
      monitor_.failure_reason(utime, {progress_->distance_m(T_odom_steered), state_.error,
                                      state_.progress_m, permission_.hold_reason()});
  if (!failure_reason) return;
  state_.kind = Kind::kFailed;
  state_.reason = *failure_reason;
}

double Driving::target_curvature_1_m(const Pose2& T_odom_steered) const {
  const PathRun& run = progress_->run();
  const double s_m = progress_->s_m();
  if (params_.controller == "pure_pursuit") {
    return pursuit_curvature(run, s_m, T_odom_steered, ramp_.speed_m_s(), params_.pure_pursuit);
  }
  const double curvature = run.curvature_1_m(s_m - kCurvatureWindowM, s_m + kCurvatureWindowM);
  LateralParams lateral = params_.pd;
  lateral.response_m *= response_share(run.clearance_m(s_m), params_.speed.clearance_full_m);
  // The drift angle is compensated where the robot is slow only: there it is accurate, and fast its
  // errors displace the robot by more than the drift.
  const double narrow = 1.0 - clearance_share(run.clearance_m(s_m), params_.speed);
  const double steering = std::lerp(1.0, hold_steering_.share(), narrow);
  return steering * lateral_curvature(error_from_middle(), curvature, run.direction(), lateral,
                                      narrow * drift_.angle_rad());
}

/// The error from the path in the middle of a narrow passage.
PathTrackingError Driving::error_from_middle() const {
  const double s_m = progress_->s_m();
  PathTrackingError error = state_.error;
  error.lateral_m -= centring_.offset_m(s_m);
  error.heading_rad -= progress_->run().direction() * centring_.slope(s_m);
  return error;
}

void Driving::move(double seconds) {
  if (progress_->run_remaining_m() <= params_.arrival_m) return finish_run(seconds);
  const double bound = steered_.curvature_max_1_m();
  ramp_.drive(target_speed_m_s(), std::clamp(target_curvature_1_m_, -bound, bound), seconds);
}

/// While the vehicle is held, and shortly after, only creeping is commanded: a release must not
/// jump to a speed that the vehicle does not have, and the guard would reject a higher speed where
/// creeping is safe.
double Driving::target_speed_m_s() const {
  const double planned = profile_->at(progress_->s_m());
  const bool is_slow = hold_steering_.is_near_hold() || permission_.hold_reason().has_value();
  const double limited = is_slow ? std::min(planned, params_.speed.creep_m_s) : planned;
  return progress_->run().direction() * limited;
}

void Driving::finish_run(double seconds) {
  ramp_.stop(seconds);
  if (!ramp_.has_stopped()) return;
  if (progress_->begin_next_run()) {
    begin_run();
  } else {
    state_.kind = Kind::kArrived;
  }
}

}  // namespace adit
