// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/driving/driving.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

#include "common/sensing/seconds.hpp"
#include "procs/driving/path_run.hpp"

namespace adit {
namespace {

constexpr double kCurvatureWindowM = 0.05;  // for the curvature at a place
constexpr double kPathLengthMaxM = 1000.0;  // of a path: no scan sees a tenth of that
constexpr double kStepMaxS = 0.2;           // that a command stands for

double length_of(const std::vector<PathPoint>& points) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    length_m +=
        (points[i].T_odom_body.translation() - points[i - 1].T_odom_body.translation()).norm();
  }
  return length_m;
}

std::string text_of(const char* format, double number) {
  char text[64];
  std::snprintf(text, sizeof text, format, number);
  return text;
}

}  // namespace

Driving::Driving(const DrivingParams& params)
    : params_(params),
      steered_(params.vehicle),
      filter_(params.smoothing_s),
      localization_(params.trust),
      hold_timeout_(params.hold_timeout_s),
      ramp_(params.speed.acceleration_m_s2, params.steering.rate_1_m_s) {
  state_.reason = "no path has come yet";
}

void Driving::follow(const PlannedPath& path) {
  state_ = {state_.utime, path.id, Kind::kIdle, path.reason, 0.0, 0.0, {}};
  if (path.outcome != PlanOutcome::kFound || path.points.empty()) return;
  state_.reason = "the path is longer than any that can be driven";
  if (!(length_of(path.points) <= kPathLengthMaxM)) return;
  state_.kind = Kind::kDriving;
  state_.reason.clear();
  std::vector<PathRun> runs = split_into_runs(path.points, steered_);
  for (PathRun& run : runs) run = blended(run, params_.steering.blend_m);
  progress_.emplace(std::move(runs));
  hold_timeout_.begin_reset();
  unobserved_.begin_reset();
  odometry_mismatch_.begin_reset();
  state_.remaining_m = progress_->remaining_m();
  begin_run();
}

void Driving::begin_run() {
  profile_.emplace(progress_->run(), params_.speed, params_.vehicle.speed_max_m_s,
                   params_.steering.rate_1_m_s);
}

void Driving::add_pose(std::int64_t utime, const Pose2& T_odom_body) {
  filter_.add(utime, steered_.pose(T_odom_body));
  odometry_mismatch_.add_pose(utime, T_odom_body);
}

void Driving::add_state(const VehicleState& state) {
  vehicle_.update(state);
  odometry_mismatch_.add_state(state);
}

void Driving::add_phase(const MissionPhase& phase, std::int64_t utime) {
  permission_.update(phase, utime);
}

void Driving::add_match(const ScanMatch& match) {
  localization_.add_match(match.utime, match.status);
  unobserved_.add_match(match);
}

DriveOutput Driving::drive(std::int64_t utime) {
  const double seconds = seconds_to(utime);
  update_permission(utime);
  if (is_active()) update_progress(utime);
  if (is_active()) {
    move(seconds);
  } else {
    ramp_.stop(seconds);
    hold_timeout_.begin_reset();
  }
  unobserved_.drive(ramp_.speed_m_s() * seconds);
  filter_.set_motion(vehicle_.speed_m_s(utime, ramp_.speed_m_s()), ramp_.curvature_1_m());
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
  auto lost_reason = localization_.lost_reason(utime, filter_.utime());
  if (!lost_reason) lost_reason = permission_.denial_reason(utime, state_.path_id);
  hold_reason_ = lost_reason ? std::nullopt : vehicle_.hold_reason(utime);
  state_.kind = lost_reason || hold_reason_ ? Kind::kWaiting : Kind::kDriving;
  state_.reason = lost_reason.value_or(hold_reason_.value_or(""));
}

/// Held, it knows where it is and is to go on.
bool Driving::is_active() const {
  return state_.kind == Kind::kDriving || (state_.kind == Kind::kWaiting && hold_reason_);
}

void Driving::update_progress(std::int64_t utime) {
  const auto reaction_us = std::llround(params_.reaction_s * 1e6);
  const Pose2 T_odom_steered = filter_.at(utime + reaction_us);
  progress_->advance(T_odom_steered);
  state_.progress_m = progress_->distance_travelled_m();
  state_.remaining_m = progress_->remaining_m();
  state_.error = progress_->error(T_odom_steered);
  target_curvature_1_m_ = target_curvature_1_m(T_odom_steered);
  check_progress(utime, T_odom_steered);
}

void Driving::check_progress(std::int64_t utime, const Pose2& T_odom_steered) {
  hold_timeout_.update(utime, state_.progress_m, hold_reason_.has_value());
  const double distance_m = progress_->distance_m(T_odom_steered);
  if (distance_m > params_.distance_max_m) {
    fail(text_of("it is %.2f m off the path", distance_m));
  } else if (std::abs(state_.error.heading_rad) > params_.heading_max_rad) {
    fail(text_of("it looks %.0f degrees off the path",
                 rad_to_deg(std::abs(state_.error.heading_rad))));
  } else if (hold_timeout_.is_reached()) {
    fail(*hold_reason_ + text_of(", no way on for %.0f s", params_.hold_timeout_s));
  } else if (unobserved_.distance_m() > params_.unobserved_distance_max_m) {
    fail(text_of("no sensor has told for %.1f m how it moves", unobserved_.distance_m()));
  } else if (std::abs(odometry_mismatch_.difference_m()) >
             params_.odometry_mismatch_max_m +
                 params_.odometry_mismatch_max_share * odometry_mismatch_.distance_travelled_m()) {
    fail(text_of("wheels and scans disagree by %.2f m", odometry_mismatch_.difference_m()));
  }
}

void Driving::fail(const std::string& reason) {
  state_.kind = Kind::kFailed;
  state_.reason = reason;
}

double Driving::target_curvature_1_m(const Pose2& T_odom_steered) const {
  const PathRun& run = progress_->run();
  const double s_m = progress_->s_m();
  if (params_.controller == "pure_pursuit") {
    return pursuit_curvature(run, s_m, T_odom_steered, ramp_.speed_m_s(), params_.pure_pursuit);
  }
  const double curvature = run.curvature_1_m(s_m - kCurvatureWindowM, s_m + kCurvatureWindowM);
  return lateral_curvature(state_.error, curvature, run.direction(), params_.pd);
}

void Driving::move(double seconds) {
  if (progress_->run_remaining_m() <= params_.arrival_m) return finish_run(seconds);
  const double bound = steered_.curvature_max_1_m();
  ramp_.drive(target_speed_m_s(), std::clamp(target_curvature_1_m_, -bound, bound), seconds);
}

/// While it is held no more than creeping is asked for: it would be let go into a speed that the
/// vehicle does not have, and be refused what it can well do slowly.
double Driving::target_speed_m_s() const {
  const double planned = profile_->at(progress_->s_m());
  const double fastest = hold_reason_ ? std::min(planned, params_.speed.creep_m_s) : planned;
  return progress_->run().direction() * fastest;
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
