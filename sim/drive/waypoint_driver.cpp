// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/drive/waypoint_driver.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

#include "common/sensing/seconds.hpp"

namespace adit {
namespace {

constexpr double kRightAngle = std::numbers::pi / 2.0;
constexpr double kBendEveryM = 0.25;  // spacing of the checks for bends ahead
constexpr double kCreepMS = 0.03;     // minimum speed, used to reach the end

}  // namespace

WaypointDriver::WaypointDriver(std::vector<Waypoint> waypoints, const Vehicle& vehicle,
                               const WaypointDriverParams& params)
    : waypoints_(std::move(waypoints)), vehicle_(vehicle), params_(params) {
  if (waypoints_.empty()) throw std::invalid_argument("there is no waypoint");
  for (const Waypoint& waypoint : waypoints_) {
    if (!waypoint.p_world.allFinite()) throw std::invalid_argument("a waypoint is not finite");
  }
}

DriveCommand WaypointDriver::command(const BodyMotion& motion) {
  const Pose2 T_world_body = in_plan(motion.T_world_body);
  if (!planned_) {
    plan(T_world_body);
    last_progress_utime_ = motion.utime;
  }
  if (!done_ && !abort_reason_) follow(T_world_body, motion.utime);
  if (done_ || abort_reason_) return {motion.utime, 0.0, 0.0};
  return {motion.utime, runs_[run_].reverse ? -speed() : speed(), curvature(T_world_body)};
}

double WaypointDriver::length_m() const {
  double length = 0.0;
  for (const DriveLegs& run : runs_) length += run.path.length_m();
  return length;
}

void WaypointDriver::plan(const Pose2& T_world_body) {
  runs_ = plan_drive(waypoints_, T_world_body,
                     {params_.speed_m_s, vehicle_.speed_max_m_s, params_.reverse});
  planned_ = true;
  done_ = runs_.empty();
}

/// Finds the position of the body along the path. The search covers the path ahead only, so that a
/// path that crosses itself is driven in order.
void WaypointDriver::follow(const Pose2& T_world_body, std::int64_t utime) {
  const WaypointPath& path = runs_[run_].path;
  const Eigen::Vector2d p_world = T_world_body.translation();
  const double to_m = std::min(path.length_m(), s_m_ + params_.lookahead_m);
  s_m_ = path.nearest_m(p_world, s_m_, to_m);
  if ((path.at(s_m_) - p_world).norm() > params_.off_path_max_m) {
    abort_reason_ = fmt::format("off the path after {:.2f} m", progress_m());
  } else if (!is_progressing(utime)) {
    abort_reason_ = fmt::format("no progress after {:.2f} m", progress_m());
  } else if (path.length_m() - s_m_ <= params_.arrival_m) {
    begin_next_run();
  }
}

bool WaypointDriver::is_progressing(std::int64_t utime) {
  if (progress_m() >= last_progress_m_ + params_.progress_min_m) {
    last_progress_m_ = progress_m();
    last_progress_utime_ = utime;
  }
  return seconds(utime - last_progress_utime_) <= params_.progress_timeout_s;
}

void WaypointDriver::begin_next_run() {
  done_ = run_ + 1 == runs_.size();
  if (done_) return;
  driven_m_ += runs_[run_].path.length_m();
  s_m_ = 0.0;
  ++run_;
}

/// Curvature of the arc, tangent to x, to the look-ahead point: 2y/d² (Coulter 1992, section 2). A
/// point on the opposite side of the body takes the tightest turn.
double WaypointDriver::curvature(const Pose2& T_world_body) const {
  const DriveLegs& run = runs_[run_];
  const Eigen::Vector2d p_body = T_world_body.inverse() * run.path.at(s_m_ + params_.lookahead_m);
  const double curvature_max = 1.0 / vehicle_.turning_radius_m;
  const bool beyond = run.reverse ? p_body.x() > 0.0 : p_body.x() < 0.0;
  if (beyond) return std::copysign(curvature_max, p_body.y());
  const double curvature = 2.0 * p_body.y() / p_body.squaredNorm();
  return std::clamp(curvature, -curvature_max, curvature_max);
}

/// Speed of the leg, reduced so that the vehicle can brake to the speeds of the bends ahead and of
/// the end.
double WaypointDriver::speed() const {
  const DriveLegs& run = runs_[run_];
  const double leg_speed = run.speeds_m_s[run.path.leg(s_m_)];
  const double left_m = run.path.length_m() - s_m_;
  double squared = std::min(leg_speed * leg_speed, 2.0 * params_.braking_m_s2 * left_m);
  const double horizon_m = leg_speed * leg_speed / (2.0 * params_.braking_m_s2);
  for (double ahead = 0.0; ahead <= std::min(horizon_m, left_m); ahead += kBendEveryM) {
    const double sharpness = std::min(1.0, bend_rad(s_m_ + ahead) / kRightAngle);
    const double bend_speed = leg_speed * (1.0 - sharpness * (1.0 - params_.slow_share));
    squared = std::min(squared, bend_speed * bend_speed + 2.0 * params_.braking_m_s2 * ahead);
  }
  return std::max(std::sqrt(squared), std::min(kCreepMS, leg_speed));
}

/// Change of the path's heading from one look-ahead distance before a point to one behind it.
double WaypointDriver::bend_rad(double s_m) const {
  const WaypointPath& path = runs_[run_].path;
  const double before = path.heading_rad(path.leg(s_m - params_.lookahead_m));
  const double behind = path.heading_rad(path.leg(s_m + params_.lookahead_m));
  return std::abs(angle_diff(behind, before));
}

}  // namespace adit
