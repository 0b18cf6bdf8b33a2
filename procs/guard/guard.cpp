// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/guard/guard.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "procs/guard/limit_checks.hpp"

namespace adit {
namespace {

constexpr double kRoundingM = 1e-6;  // of sums of lengths that are equal

std::string joined(const std::vector<StopReason>& reasons) {
  std::string line;
  for (const StopReason& reason : reasons) line += (line.empty() ? "" : "; ") + reason.text;
  return line;
}

void check_laser(const std::string& laser, const LaserMount& mount, const GuardParams& params) {
  const Vehicle& vehicle = params.vehicle;
  if (!(mount.height_m > vehicle.step_max_m && mount.height_m < vehicle.height_m)) {
    throw std::invalid_argument(
        fmt::format("lasers: {}.height_m ({}) must be between vehicle.step_max_m ({}) and "
                    "vehicle.height_m ({}), or the guard sees no obstacles",
                    laser, mount.height_m, vehicle.step_max_m, vehicle.height_m));
  }
  const double range_end_m = std::abs(mount.T_body_laser.x) + mount.range_min_m;
  const double blind_m = range_end_m - 0.5 * vehicle.length_m;
  if (blind_m > params.obstacle.margin_m + kRoundingM) {
    throw std::invalid_argument(fmt::format(
        "guard: obstacle.margin_m ({:.3f}) must be at least the blind range of lasers.{} ahead of "
        "the vehicle, |x_m| + range_min_m - vehicle.length_m / 2 = {:.3f} + {:.3f} - {:.3f} = "
        "{:.3f} m",
        params.obstacle.margin_m, laser, std::abs(mount.T_body_laser.x), mount.range_min_m,
        0.5 * vehicle.length_m, blind_m));
  }
}

/// Returns the parameters if the guard can work with them.
GuardParams validated(const GuardParams& params) {
  check_laser("front", params.lasers.front, params);
  if (params.lasers.has_rear()) check_laser("rear", params.lasers.rear, params);
  if (!(params.tilt_margin_rad < params.vehicle.tilt_max_rad)) {
    throw std::invalid_argument("guard: tilt_margin_rad must be less than vehicle.tilt_max_rad");
  }
  return params;
}

}  // namespace

Guard::Guard(const GuardParams& params)
    : params_(validated(params)),
      surroundings_(params),
      attitude_(params.attitude),
      latch_(params.hold_s) {}

void Guard::receive(LaserId laser, const LaserScan& scan, std::int64_t now) {
  time_.advance_to(now);
  const auto up_body = attitude_.up_body().value_or(Eigen::Vector3d::UnitZ());
  surroundings_.receive(laser, scan, time_.monotonic_us(scan.utime), up_body);
}

void Guard::receive(LaserId laser, const TiltReading& reading, std::int64_t now) {
  time_.advance_to(now);
  surroundings_.receive(laser, reading, time_.monotonic_us(reading.utime));
}

void Guard::receive(const DriveCommand& command, std::int64_t now) {
  time_.advance_to(now);
  if (command_received_.receive(time_.monotonic_us(command.utime))) command_ = command;
}

void Guard::receive(const VehicleState& state, std::int64_t now) {
  time_.advance_to(now);
  const std::int64_t at_us = time_.monotonic_us(state.utime);
  if (!state_received_.receive(at_us)) return;
  state_ = state;
  travel_.add(state.speed_m_s, at_us);
}

void Guard::receive(const ImuReading& reading, std::int64_t now) {
  time_.advance_to(now);
  const std::int64_t at_us = time_.monotonic_us(reading.utime);
  if (imu_received_.receive(at_us)) attitude_.add(reading, at_us);
}

void Guard::receive(const GasReading& reading, std::int64_t now) {
  time_.advance_to(now);
  if (gas_received_.receive(time_.monotonic_us(reading.utime))) gas_ = reading;
}

void Guard::receive(const SinkageReading& reading, std::int64_t now) {
  time_.advance_to(now);
  if (sinkage_received_.receive(time_.monotonic_us(reading.utime))) sinkage_ = reading;
}

void Guard::receive_pose(const Pose2& T_odom_body, std::int64_t utime, std::int64_t now) {
  time_.advance_to(now);
  if (pose_received_.receive(time_.monotonic_us(utime))) surroundings_.move_to(T_odom_body);
}

void Guard::receive_supervisor(std::int64_t utime, std::int64_t now) {
  time_.advance_to(now);
  supervisor_received_.receive(time_.monotonic_us(utime));
}

void Guard::receive_stop(std::int64_t now) { stop_received_.receive(time_.advance_to(now)); }

StopOrder Guard::evaluate(std::int64_t now) {
  time_.advance_to(now);
  find_reasons();
  count_new();
  if (!reasons_.empty()) last_reasons_ = joined(reasons_);
  const bool stopped =
      latch_.evaluate(!reasons_.empty(), command_received_.at_us(), time_.now_us());
  stopped_by_obstacle_ = stopped && (stopped_by_obstacle_ ||
                                     active_.at(static_cast<std::size_t>(StopKind::kObstacle)));
  if (!stopped) return {now, false, ""};
  return {now, true, reasons_.empty() ? "release pending, was: " + last_reasons_ : last_reasons_};
}

void Guard::find_reasons() {
  reasons_.clear();
  const std::int64_t now_us = time_.now_us();
  const int direction = direction_of(commanded_motion());
  const int travelled = travel_.direction() != 0 ? travel_.direction() : direction;
  const auto unless_retreat = [&](RetreatPermission& retreat, const Text& reason) {
    return retreat.forbids(reason.has_value(), direction, travelled, now_us) ? reason : Text();
  };
  add(StopKind::kObstacle, obstacle());
  add(StopKind::kLaser, lasers());
  add(StopKind::kPose, pose_received_.staleness("pose", now_us, params_.timeout_s));
  add(StopKind::kCommand, command());
  add(StopKind::kTilt, unless_retreat(tilt_retreat_, tilt()));
  add(StopKind::kSinkage, unless_retreat(sinkage_retreat_, sinkage()));
  add(StopKind::kGas, unless_retreat(gas_retreat_, gas()));
  add(StopKind::kSupervisor, supervisor());
}

void Guard::add(StopKind kind, Text text) {
  if (text) reasons_.push_back({kind, std::move(*text)});
}

void Guard::count_new() {
  std::array<bool, kStopKindNames.size()> active{};
  for (const StopReason& reason : reasons_) active.at(static_cast<std::size_t>(reason.kind)) = true;
  for (std::size_t i = 0; i < active.size(); ++i) counts_.at(i) += active.at(i) && !active_.at(i);
  active_ = active;
}

Guard::Text Guard::command() const {
  if (stop_received_.is_fresh(time_.now_us(), kForeignStopS)) return "stop ordered by another";
  return command_received_.staleness("command", time_.now_us(), params_.timeout_s);
}

ArcMotion Guard::commanded_motion() const {
  if (!command_received_.is_fresh(time_.now_us(), params_.timeout_s)) return {};
  const double max = params_.vehicle.speed_max_m_s;
  return {std::clamp(command_.speed_m_s, -max, max), command_.curvature_1_m};
}

/// The motion differs from the command while the vehicle brakes or steers.
ArcMotion Guard::measured_motion() const {
  if (!state_received_.is_fresh(time_.now_us(), params_.timeout_s)) return {};
  if (std::abs(state_.speed_m_s) < TravelDirection::kStandsM_S) return {};
  return {state_.speed_m_s, state_.curvature_1_m};
}

Guard::Text Guard::obstacle() const {
  const std::int64_t now_us = time_.now_us();
  if (auto text = surroundings_.obstacle_on(commanded_motion(), "the commanded arc",
                                            stopped_by_obstacle_, now_us)) {
    return text;
  }
  return surroundings_.obstacle_on(measured_motion(), "the measured arc", stopped_by_obstacle_,
                                   now_us);
}

Guard::Text Guard::lasers() const {
  if (auto text = surroundings_.laser_fault_on(commanded_motion(), time_.now_us())) return text;
  return surroundings_.laser_fault_on(measured_motion(), time_.now_us());
}

Guard::Text Guard::tilt() const {
  const std::int64_t now_us = time_.now_us();
  if (auto text = imu_received_.staleness_if_received("IMU", now_us, params_.timeout_s))
    return text;
  if (!imu_received_.at_us()) return std::nullopt;
  if (!attitude_.is_known(now_us)) return "IMU without gravity";
  const double max_rad = params_.vehicle.tilt_max_rad - params_.tilt_margin_rad;
  return tilt_reason(*attitude_.up_body(), max_rad);
}

Guard::Text Guard::sinkage() const {
  const std::int64_t now_us = time_.now_us();
  if (auto text =
          sinkage_received_.staleness_if_received("sinkage", now_us, params_.slow_timeout_s)) {
    return text;
  }
  return sinkage_reason(sinkage_, params_.sinkage_share * params_.vehicle.sinkage_max_m);
}

Guard::Text Guard::gas() const {
  const std::int64_t now_us = time_.now_us();
  if (auto text = gas_received_.staleness_if_received("gas", now_us, params_.slow_timeout_s))
    return text;
  return air_reason(gas_, params_.air);
}

Guard::Text Guard::supervisor() const {
  const std::int64_t now_us = time_.now_us();
  const double timeout_s = params_.supervisor_timeout_s;
  if (params_.require_supervisor)
    return supervisor_received_.staleness("supervisor", now_us, timeout_s);
  return supervisor_received_.staleness_if_received("supervisor", now_us, timeout_s);
}

}  // namespace adit
