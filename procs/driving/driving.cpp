// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/driving/driving.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

#include "common/sensing/seconds.hpp"
#include "procs/driving/blended_run.hpp"

namespace adit {
namespace {

constexpr double kAroundM = 0.05;     // for the curvature at a place
constexpr double kLongestM = 1000.0;  // of a path: no scan sees a tenth of that
constexpr double kStepMaxS = 0.2;     // that a command stands for

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
      trust_(params.trust),
      hold_limit_(params.held_max_s),
      ramp_(params.speed.acceleration_m_s2, params.steering.rate_1_m_s) {
  state_.reason = "no path has come yet";
}

void Driving::follow(const PlannedPath& path) {
  state_ = {state_.utime, path.id, Kind::kIdle, path.reason, 0.0, 0.0, {}};
  if (path.outcome != PlanOutcome::kFound || path.points.empty()) return;
  state_.reason = "the path is longer than any that can be driven";
  if (!(length_of(path.points) <= kLongestM)) return;
  state_.kind = Kind::kDriving;
  state_.reason.clear();
  std::vector<PathRun> runs = runs_of(path.points, steered_);
  for (PathRun& run : runs) run = blended(run, params_.steering.blend_m);
  progress_.emplace(std::move(runs));
  hold_limit_.begin_anew();
  unmeasured_.begin_anew();
  wheels_.begin_anew();
  state_.remaining_m = progress_->remaining_m();
  begin_run();
}

void Driving::begin_run() {
  profile_.emplace(progress_->run(), params_.speed, params_.vehicle.speed_max_m_s,
                   params_.steering.rate_1_m_s);
}

void Driving::add_pose(std::int64_t utime, const Pose2& T_odom_body) {
  filter_.add(utime, steered_.pose(T_odom_body));
  wheels_.add_pose(utime, T_odom_body);
}

void Driving::add_state(const VehicleState& state) {
  vehicle_.hear(state);
  wheels_.add_state(state);
}

void Driving::add_phase(const MissionPhase& phase, std::int64_t utime) {
  leave_.hear(phase, utime);
}

void Driving::add_match(const ScanMatch& match) {
  trust_.add_match(match.utime, match.status);
  unmeasured_.add_match(match);
}

DriveOutput Driving::drive(std::int64_t utime) {
  const double seconds = seconds_to(utime);
  trust_or_wait(utime);
  if (is_under_way()) locate(utime);
  if (is_under_way()) {
    move(seconds);
  } else {
    ramp_.stand(seconds);
    hold_limit_.begin_anew();
  }
  unmeasured_.drive(ramp_.speed_m_s() * seconds);
  filter_.set_motion(vehicle_.speed_m_s(utime, ramp_.speed_m_s()), ramp_.curvature_1_m());
  return {{utime, ramp_.speed_m_s(), steered_.curvature_of_origin(ramp_.curvature_1_m())}, state_};
}

double Driving::seconds_to(std::int64_t utime) {
  const std::int64_t since = utime_ ? utime - *utime_ : 0;
  utime_ = utime;
  state_.utime = utime;
  return std::clamp(seconds(since), 0.0, kStepMaxS);
}

void Driving::trust_or_wait(std::int64_t utime) {
  if (state_.kind != Kind::kDriving && state_.kind != Kind::kWaiting) return;
  auto doubt = trust_.doubt(utime, filter_.utime());
  if (!doubt) doubt = leave_.refusal(utime, state_.path_id);
  held_ = doubt ? std::nullopt : vehicle_.hold(utime);
  state_.kind = doubt || held_ ? Kind::kWaiting : Kind::kDriving;
  state_.reason = doubt.value_or(held_.value_or(""));
}

/// Held, it knows where it is and is to go on.
bool Driving::is_under_way() const {
  return state_.kind == Kind::kDriving || (state_.kind == Kind::kWaiting && held_);
}

void Driving::locate(std::int64_t utime) {
  const auto reaction_us = std::llround(params_.reaction_s * 1e6);
  const Pose2 T_odom_steered = filter_.at(utime + reaction_us);
  progress_->advance(T_odom_steered);
  state_.progress_m = progress_->done_m();
  state_.remaining_m = progress_->remaining_m();
  state_.error = progress_->error(T_odom_steered);
  wanted_1_m_ = curvature_to(T_odom_steered);
  judge(utime, T_odom_steered);
}

void Driving::judge(std::int64_t utime, const Pose2& T_odom_steered) {
  hold_limit_.go_on(utime, state_.progress_m, held_.has_value());
  const double distance_m = progress_->distance_m(T_odom_steered);
  if (distance_m > params_.distance_max_m) {
    fail(text_of("it is %.2f m off the path", distance_m));
  } else if (std::abs(state_.error.heading_rad) > params_.heading_max_rad) {
    fail(text_of("it looks %.0f degrees off the path",
                 rad_to_deg(std::abs(state_.error.heading_rad))));
  } else if (hold_limit_.is_reached()) {
    fail(*held_ + text_of(", no way on for %.0f s", params_.held_max_s));
  } else if (unmeasured_.way_m() > params_.unmeasured_max_m) {
    fail(text_of("no sensor has told for %.1f m how it moves", unmeasured_.way_m()));
  } else if (std::abs(wheels_.apart_m()) >
             params_.wheels_apart_m + params_.wheels_apart_share * wheels_.driven_m()) {
    fail(text_of("wheels and scans disagree by %.2f m", wheels_.apart_m()));
  }
}

void Driving::fail(const std::string& reason) {
  state_.kind = Kind::kFailed;
  state_.reason = reason;
}

double Driving::curvature_to(const Pose2& T_odom_steered) const {
  const PathRun& run = progress_->run();
  const double s_m = progress_->s_m();
  if (params_.controller == "pure_pursuit") {
    return pursuit_curvature(run, s_m, T_odom_steered, ramp_.speed_m_s(), params_.pure_pursuit);
  }
  const double curvature = run.curvature_1_m(s_m - kAroundM, s_m + kAroundM);
  return lateral_curvature(state_.error, curvature, run.direction(), params_.pd);
}

void Driving::move(double seconds) {
  if (progress_->run_remaining_m() <= params_.arrival_m) return end_run(seconds);
  const double most = steered_.curvature_max_1_m();
  ramp_.drive(speed_here(), std::clamp(wanted_1_m_, -most, most), seconds);
}

/// While it is held no more than creeping is asked for: it would be let go into a speed that the
/// vehicle does not have, and be refused what it can well do slowly.
double Driving::speed_here() const {
  const double planned = profile_->at(progress_->s_m());
  const double fastest = held_ ? std::min(planned, params_.speed.creep_m_s) : planned;
  return progress_->run().direction() * fastest;
}

void Driving::end_run(double seconds) {
  ramp_.stand(seconds);
  if (!ramp_.has_stood()) return;
  if (progress_->begin_next_run()) {
    begin_run();
  } else {
    state_.kind = Kind::kArrived;
  }
}

}  // namespace adit
