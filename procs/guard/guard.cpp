// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/guard/guard.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "procs/guard/arc_sweep.hpp"
#include "procs/guard/decimal_text.hpp"
#include "procs/guard/obstacle_check.hpp"
#include "procs/guard/tilt_check.hpp"

namespace adit {
namespace {

constexpr double kStandsM_S = 0.01;  // measured; slower is no motion

int direction_of(double speed_m_s) { return (speed_m_s > 0.0 ? 1 : 0) - (speed_m_s < 0.0 ? 1 : 0); }

void check(const std::string& laser, const LaserMount& mount, const GuardParams& params) {
  const Vehicle& vehicle = params.vehicle;
  if (!(mount.height_m > vehicle.step_max_m && mount.height_m < vehicle.height_m)) {
    throw std::invalid_argument("lasers: " + laser +
                                ".height_m is not between vehicle.step_max_m and vehicle.height_m: "
                                "the guard would take all that it sees for ground or roof");
  }
  const double blind_to_m = std::abs(mount.T_body_laser.x) + mount.range_min_m;
  if (blind_to_m - 0.5 * vehicle.length_m > params.obstacle.margin_m) {
    throw std::invalid_argument("guard: obstacle.margin_m is less than what lasers." + laser +
                                " is blind for, ahead of the vehicle");
  }
}

GuardParams checked(const GuardParams& params) {
  check("front", params.lasers.front, params);
  check("rear", params.lasers.rear, params);
  if (!(params.tilt_margin_rad < params.vehicle.tilt_max_rad)) {
    throw std::invalid_argument("guard: tilt_margin_rad is not less than vehicle.tilt_max_rad");
  }
  return params;
}

std::string obstacle_text(const std::string& what, double way_m, double stopping_m,
                          const ArcMotion& motion, const char* arc) {
  const char* where = direction_of(motion.speed_m_s) > 0 ? " m ahead on " : " m behind on ";
  return what + decimal_text(way_m, 2) + where + arc + ", stopping takes " +
         decimal_text(stopping_m, 2) + " m";
}

std::string joined(const std::vector<StopReason>& reasons) {
  std::string line;
  for (const StopReason& reason : reasons) line += (line.empty() ? "" : "; ") + reason.text;
  return line;
}

}  // namespace

Guard::Guard(const GuardParams& params)
    : params_(checked(params)),
      front_("laser front", params.lasers.front),
      rear_("laser rear", params.lasers.rear),
      flanks_(params.vehicle, params.lasers),
      attitude_(params.attitude),
      latch_(params.hold_s) {}

void Guard::hear(LaserId laser, const LaserScan& scan, std::int64_t now) {
  time_.go_on_to(now);
  const auto up_body = attitude_.up_body().value_or(Eigen::Vector3d::UnitZ());
  if (!of(laser).hear(scan, time_.of(scan.utime), up_body, params_.vehicle)) return;
  flanks_.see(laser, of(laser).points());
}

void Guard::hear(LaserId laser, const TiltReading& reading, std::int64_t now) {
  time_.go_on_to(now);
  of(laser).hear(reading, time_.of(reading.utime));
}

void Guard::hear(const DriveCommand& command, std::int64_t now) {
  time_.go_on_to(now);
  if (command_heard_.hear(time_.of(command.utime))) command_ = command;
}

void Guard::hear(const VehicleState& state, std::int64_t now) {
  time_.go_on_to(now);
  if (state_heard_.hear(time_.of(state.utime))) state_ = state;
}

void Guard::hear(const ImuReading& reading, std::int64_t now) {
  time_.go_on_to(now);
  const std::int64_t at_us = time_.of(reading.utime);
  if (imu_heard_.hear(at_us)) attitude_.add(reading, at_us);
}

void Guard::hear(const GasReading& reading, std::int64_t now) {
  time_.go_on_to(now);
  if (gas_heard_.hear(time_.of(reading.utime))) gas_ = reading;
}

void Guard::hear(const SinkageReading& reading, std::int64_t now) {
  time_.go_on_to(now);
  if (sinkage_heard_.hear(time_.of(reading.utime))) sinkage_ = reading;
}

void Guard::hear_pose(const Pose2& T_odom_body, std::int64_t utime, std::int64_t now) {
  time_.go_on_to(now);
  if (pose_heard_.hear(time_.of(utime))) flanks_.move_to(T_odom_body);
}

void Guard::hear_supervisor(std::int64_t utime, std::int64_t now) {
  time_.go_on_to(now);
  supervisor_heard_.hear(time_.of(utime));
}

StopOrder Guard::judge(std::int64_t now) {
  time_.go_on_to(now);
  find_reasons();
  count_new();
  if (!reasons_.empty()) told_ = joined(reasons_);
  const bool stopped = latch_.judge(!reasons_.empty(), command_heard_.at_us(), time_.now_us());
  if (!stopped) return {now, false, ""};
  return {now, true, reasons_.empty() ? "to be released, was: " + told_ : told_};
}

void Guard::find_reasons() {
  reasons_.clear();
  const std::int64_t now_us = time_.now_us();
  const int direction = direction_of(commanded().speed_m_s);
  const auto unless_leaving = [&](WayBack& way_back, const Text& reason) {
    return way_back.forbids(reason.has_value(), direction, now_us) ? reason : Text();
  };
  add(StopKind::kObstacle, obstacle());
  add(StopKind::kLaser, lasers());
  add(StopKind::kPose, pose_heard_.silence("pose", now_us, params_.timeout_s));
  add(StopKind::kCommand, command_heard_.silence("command", now_us, params_.timeout_s));
  add(StopKind::kTilt, unless_leaving(out_of_tilt_, tilt()));
  add(StopKind::kSinkage, unless_leaving(out_of_mud_, sinkage()));
  add(StopKind::kGas, unless_leaving(out_of_gas_, gas()));
  add(StopKind::kSupervisor, supervisor());
}

void Guard::add(StopKind kind, Text text) {
  if (text) reasons_.push_back({kind, std::move(*text)});
}

void Guard::count_new() {
  std::array<bool, kStopKindNames.size()> holds{};
  for (const StopReason& reason : reasons_) holds.at(static_cast<std::size_t>(reason.kind)) = true;
  for (std::size_t i = 0; i < holds.size(); ++i) counts_.at(i) += holds.at(i) && !held_.at(i);
  held_ = holds;
}

ArcMotion Guard::commanded() const {
  if (!command_heard_.is_fresh(time_.now_us(), params_.timeout_s)) return {};
  const double max = params_.vehicle.speed_max_m_s;
  return {std::clamp(command_.speed_m_s, -max, max), command_.curvature_1_m};
}

/// What the vehicle itself says: it brakes before it obeys, and steers while it drives.
ArcMotion Guard::rolling() const {
  if (!state_heard_.is_fresh(time_.now_us(), params_.timeout_s)) return {};
  if (std::abs(state_.speed_m_s) < kStandsM_S) return {};
  return {state_.speed_m_s, state_.curvature_1_m};
}

Guard::Text Guard::obstacle() const {
  if (auto text = obstacle_on(commanded(), "the commanded arc")) return text;
  return obstacle_on(rolling(), "the arc that it is on");
}

Guard::Text Guard::obstacle_on(const ArcMotion& motion, const char* arc) const {
  if (direction_of(motion.speed_m_s) == 0) return std::nullopt;
  const ArcSweep sweep(params_.vehicle, motion, params_.obstacle.side_margin_m);
  for (const LaserWatch* laser : {&front_, &rear_}) {
    const auto age_s = laser->age_s(time_.now_us());
    if (!age_s || *age_s > params_.timeout_s) continue;  // where it was, the vehicle is no more
    const double stopping_m = stopping_distance_m(params_.obstacle, motion.speed_m_s, *age_s);
    const double way_m = way_to_obstacle_m(laser->points(), sweep, stopping_m);
    if (!std::isinf(way_m)) return obstacle_text("obstacle ", way_m, stopping_m, motion, arc);
  }
  const double stopping_m = stopping_distance_m(params_.obstacle, motion.speed_m_s, 0.0);
  const double way_m = way_to_nearest_m(flanks_.p_body(), sweep, stopping_m);
  if (!std::isinf(way_m))
    return obstacle_text("remembered obstacle ", way_m, stopping_m, motion, arc);
  return std::nullopt;
}

Guard::Text Guard::lasers() const {
  const int commanded_to = direction_of(commanded().speed_m_s);
  const int rolls_to = direction_of(rolling().speed_m_s);
  for (const auto& [laser, direction] : {std::pair{&front_, 1}, std::pair{&rear_, -1}}) {
    if (commanded_to != direction && rolls_to != direction) continue;
    if (auto fault = laser->fault(time_.now_us(), params_.timeout_s)) return fault;
  }
  return std::nullopt;
}

Guard::Text Guard::tilt() const {
  const std::int64_t now_us = time_.now_us();
  if (auto text = imu_heard_.silence_once_heard("inertial unit", now_us, params_.timeout_s)) {
    return text;
  }
  if (!imu_heard_.at_us()) return std::nullopt;
  if (!attitude_.is_known(now_us)) return "inertial unit without gravity";
  const double max_rad = params_.vehicle.tilt_max_rad - params_.tilt_margin_rad;
  return tilt_reason(*attitude_.up_body(), max_rad);
}

Guard::Text Guard::sinkage() const {
  const std::int64_t now_us = time_.now_us();
  if (auto text = sinkage_heard_.silence_once_heard("sinkage", now_us, params_.slow_timeout_s)) {
    return text;
  }
  return sinkage_reason(sinkage_, params_.sinkage_share * params_.vehicle.sinkage_max_m);
}

Guard::Text Guard::gas() const {
  const std::int64_t now_us = time_.now_us();
  if (auto text = gas_heard_.silence_once_heard("gas", now_us, params_.slow_timeout_s)) return text;
  return air_reason(gas_, params_.air);
}

Guard::Text Guard::supervisor() const {
  const std::int64_t now_us = time_.now_us();
  const double timeout_s = params_.supervisor_timeout_s;
  if (params_.require_supervisor) return supervisor_heard_.silence("supervisor", now_us, timeout_s);
  return supervisor_heard_.silence_once_heard("supervisor", now_us, timeout_s);
}

}  // namespace adit
