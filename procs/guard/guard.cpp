// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/guard/guard.hpp"

#include <algorithm>
#include <cmath>

#include "procs/guard/tilt_check.hpp"

namespace adit {
namespace {

constexpr double kStandsM_S = 0.01;  // measured; slower is no motion

std::string joined(const std::vector<StopReason>& reasons) {
  std::string line;
  for (const StopReason& reason : reasons) line += (line.empty() ? "" : "; ") + reason.text;
  return line;
}

}  // namespace

Guard::Guard(const GuardParams& params)
    : params_(usable(params)),
      surroundings_(params),
      attitude_(params.attitude),
      latch_(params.hold_s) {}

void Guard::hear(LaserId laser, const LaserScan& scan, std::int64_t now) {
  time_.go_on_to(now);
  const auto up_body = attitude_.up_body().value_or(Eigen::Vector3d::UnitZ());
  surroundings_.hear(laser, scan, time_.of(scan.utime), up_body);
}

void Guard::hear(LaserId laser, const TiltReading& reading, std::int64_t now) {
  time_.go_on_to(now);
  surroundings_.hear(laser, reading, time_.of(reading.utime));
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
  if (pose_heard_.hear(time_.of(utime))) surroundings_.move_to(T_odom_body);
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
  const int direction = direction_of(commanded());
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
  const std::int64_t now_us = time_.now_us();
  if (auto text = surroundings_.obstacle_on(commanded(), "the commanded arc", now_us)) return text;
  return surroundings_.obstacle_on(rolling(), "the arc that it is on", now_us);
}

Guard::Text Guard::lasers() const {
  if (auto text = surroundings_.blindness_on(commanded(), time_.now_us())) return text;
  return surroundings_.blindness_on(rolling(), time_.now_us());
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
