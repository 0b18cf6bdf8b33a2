// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/scan_matching/motion/motion_prediction.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "common/sensing/seconds.hpp"

namespace adit {
namespace {

constexpr std::size_t kReadingsStored = 2000;
constexpr std::size_t kReadingsMax =
    100'000;                         // while no scan comes: a quarter of an hour at 100 Hz
constexpr double kShortestS = 0.01;  // shorter steps are not more accurate
constexpr double kLongS = 1.0;       // without a scan
constexpr double kTurnSigmas = 3.9;  // of the gyro over a long step: a normal distribution, 0.9999
constexpr double kTurnErrorRad = 0.2;  // in addition: times, and turns about other axes

/// Those since `from_utime`, the last scan, are kept however long ago it was.
template <class Reading>
bool append(std::deque<Reading>& readings, const Reading& reading,
            const std::optional<std::int64_t>& from_utime) {
  if (!readings.empty() && reading.utime <= readings.back().utime) return false;
  readings.push_back(reading);
  while (readings.size() > kReadingsStored) {
    const bool needed = from_utime && readings[1].utime > *from_utime;
    if (needed && readings.size() <= kReadingsMax) break;
    readings.pop_front();
  }
  return true;
}

}  // namespace

bool MotionPrediction::add(const WheelOdometry& reading) {
  return append(wheels_, reading, utime_);
}

bool MotionPrediction::add(const ImuReading& reading, const Attitude& attitude) {
  const double rad_s = heading_rate_rad_s(attitude, reading.angular_velocity);
  return append(gyro_, HeadingRate{reading.utime, rad_s}, utime_);
}

void MotionPrediction::clear_readings() {
  wheels_.clear();
  gyro_.clear();
}

void MotionPrediction::shift_time(std::int64_t shift_us) {
  if (utime_) *utime_ += shift_us;
  if (speed_utime_) *speed_utime_ += shift_us;
  located_utime_ += shift_us;
}

bool MotionEstimate::possible(const Pose2& T_odom_body) const {
  const Pose2 step = between(T_odom_last, T_odom_body);
  const double turn_error = std::abs(between(prior.T_odom_body, T_odom_body).theta);
  return step.translation().norm() <= displacement_max_m && std::abs(step.theta) <= turn_max_rad &&
         turn_error <= turn_error_max_rad;
}

std::optional<double> MotionPrediction::gyro_turn(std::int64_t from, std::int64_t to) const {
  // A reading is valid until the next; a gap makes the turn unknown.
  double turn = 0.0;
  std::int64_t covered = from;
  for (auto it = gyro_.begin(); it != gyro_.end() && covered < to; ++it) {
    const auto next = std::next(it);
    const std::int64_t until = next == gyro_.end() ? to : std::min(to, next->utime);
    if (until <= covered) continue;
    const bool late = it->utime > covered + static_cast<std::int64_t>(1e6 * params_.gyro_gap_max_s);
    const bool long_gap = seconds(until - it->utime) > params_.gyro_gap_max_s;
    if (late || long_gap) return std::nullopt;
    turn += it->rad_s * seconds(until - covered);
    covered = until;
  }
  if (covered < to) return std::nullopt;
  return turn;
}

Pose2 MotionPrediction::step_at_last_speed(double dt_s) const {
  // The speed decays with time, the turn rate faster. The body moves along an arc: the translation
  // is rotated by half of the turn.
  const auto lasting = [dt_s](double memory) { return memory * (1.0 - std::exp(-dt_s / memory)); };
  const double turn = speed_body_.z() * lasting(params_.turn_memory_s);
  const double drive = lasting(params_.speed_memory_s);
  const Pose2 half{0.0, 0.0, 0.5 * turn};
  const Pose2 straight{speed_body_.x() * drive, speed_body_.y() * drive, 0.0};
  return half * straight * half;
}

MotionEstimate MotionPrediction::predict(std::int64_t utime, double wheels_scale) const {
  MotionEstimate estimate;
  estimate.prior.T_odom_body = T_odom_body_;
  estimate.T_odom_last = T_odom_body_;
  if (!utime_) return estimate;
  const double dt = seconds(utime - *utime_);
  estimate.displacement_max_m = params_.speed_max_m_s * (dt + params_.stamp_error_max_s);
  estimate.turn_max_rad = params_.yaw_rate_max_rad_s * (dt + params_.stamp_error_max_s);
  estimate.prior.T_odom_body = T_odom_body_ * step_at_last_speed(dt);
  apply_odometry(utime, wheels_scale, estimate);
  apply_gyro(utime, estimate);
  if (!estimate.from_odometry) bound_unmeasured(utime, estimate);
  return estimate;
}

void MotionPrediction::apply_odometry(std::int64_t utime, double wheels_scale,
                                      MotionEstimate& estimate) const {
  const auto then = wheel_pose_at(wheels_, *utime_, params_.odometry_gap_max_s);
  const auto now = wheel_pose_at(wheels_, utime, params_.odometry_gap_max_s);
  if (!then || !now) return;
  estimate.wheels_step = between(*then, *now);
  Pose2 step = estimate.wheels_step;
  step.x *= wheels_scale;
  step.y *= wheels_scale;
  if (!estimate.possible(T_odom_body_ * step)) return;  // spinning or reset wheels
  const double distance = step.translation().norm();
  // Makes the uncertainty over a second independent of the number of steps.
  const double share = std::sqrt(
      std::min(1.0, std::max(seconds(utime - *utime_), kShortestS) / params_.odometry_sd_time_s));
  const double sd = share * params_.odometry_sd_m + params_.odometry_sd_per_m * distance;
  const double sd_theta = share * params_.odometry_sd_rad +
                          params_.odometry_sd_per_rad * std::abs(step.theta) +
                          params_.odometry_sd_rad_per_m * distance;
  estimate.prior.T_odom_body = T_odom_body_ * step;
  estimate.prior.information.diagonal() << 1.0 / (sd * sd), 1.0 / (sd * sd),
      1.0 / (sd_theta * sd_theta);
  estimate.from_odometry = true;
  const std::int64_t stationary_since = utime - std::llround(1e6 * params_.stationary_s);
  estimate.stationary = wheels_stationary(wheels_, std::min(stationary_since, *utime_));
}

void MotionPrediction::apply_gyro(std::int64_t utime, MotionEstimate& estimate) const {
  const auto turn = gyro_turn(*utime_, utime);
  if (!turn) return;
  const double sd = params_.gyro_sd_rad_s * std::max(seconds(utime - *utime_), 0.01);
  estimate.prior.T_odom_body.theta = wrap_angle(T_odom_body_.theta + *turn);
  estimate.prior.information(2, 2) = 1.0 / (sd * sd);
  estimate.from_gyro = true;
  if (seconds(utime - *utime_) > kLongS) {
    estimate.turn_error_max_rad = kTurnErrorRad + kTurnSigmas * sd;
  }
  const double turned_max =
      params_.stationary_turn_max_rad_s * std::max(seconds(utime - *utime_), 0.1);
  estimate.stationary = estimate.stationary && std::abs(*turn) <= turned_max;
}

/// Without wheels, what scans that matched nothing contribute is a guess: the bounds of motion hold
/// from the last scan that was located.
void MotionPrediction::bound_unmeasured(std::int64_t utime, MotionEstimate& estimate) const {
  const double since_s = seconds(utime - located_utime_);
  estimate.T_odom_last = T_odom_located_;
  estimate.displacement_max_m = params_.speed_max_m_s * (since_s + params_.stamp_error_max_s);
  estimate.turn_max_rad = params_.yaw_rate_max_rad_s * (since_s + params_.stamp_error_max_s);
  estimate.speed_known = speed_known_;
  estimate.unmeasured_s = since_s;
  estimate.unmeasured_m = params_.speed_max_m_s * since_s;
  estimate.unmeasured_rad = estimate.from_gyro ? 0.0 : params_.yaw_rate_max_rad_s * since_s;
}

/// Makes the extrapolated distance independent of the number of steps.
void MotionPrediction::decay_speed(double dt_s) {
  speed_body_.head<2>() *= std::exp(-dt_s / params_.speed_memory_s);
  speed_body_.z() *= std::exp(-dt_s / params_.turn_memory_s);
}

void MotionPrediction::correct(std::int64_t utime, const Pose2& T_odom_body, bool measured,
                               bool located) {
  if (located || !utime_) {
    located_utime_ = utime;
    T_odom_located_ = T_odom_body;
  }
  if (utime_ && !measured) decay_speed(seconds(utime - *utime_));
  utime_ = utime;
  T_odom_body_ = T_odom_body;
  if (!measured && speed_utime_) return;
  if (!speed_utime_) {
    speed_utime_ = utime;
    T_odom_speed_ = T_odom_body;
    return;
  }
  const double dt = seconds(utime - *speed_utime_);
  if (dt < params_.speed_baseline_s) return;
  const Pose2 step = between(T_odom_speed_, T_odom_body);
  const Pose2 unturn{0.0, 0.0, -0.5 * step.theta};
  const Eigen::Vector2d along = (unturn * step.translation()) / dt;
  const double shrink = std::min(1.0, params_.speed_max_m_s / std::max(along.norm(), 1e-9));
  speed_body_ << shrink * along,
      std::clamp(step.theta / dt, -params_.yaw_rate_max_rad_s, params_.yaw_rate_max_rad_s);
  speed_known_ = true;
  speed_utime_ = utime;
  T_odom_speed_ = T_odom_body;
}

}  // namespace adit
