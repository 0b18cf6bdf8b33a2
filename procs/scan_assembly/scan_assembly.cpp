// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/scan_assembly/scan_assembly.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "common/sensing/seconds.hpp"
#include "procs/scan_assembly/ring_placement.hpp"

namespace adit {
namespace {

using Phase = SweepMotion::Phase;

constexpr double kCloudInTransitS = 2.0;
constexpr double kImuTimeoutS = 0.5;

const char* name_of(LaserId laser) {
  return laser == LaserId::kFront ? "the front laser" : "the rear laser";
}

}  // namespace

ScanAssembly::ScanAssembly(const ScanAssemblyParams& params)
    : params_(params),
      sweep_(params.sweep),
      gravity_(params.gravity),
      passed_(params.passed_revolutions, params.lasers, params.mixed_pixels) {}

void ScanAssembly::begin(const ScanRequest& request, std::int64_t utime) {
  if (is_repeat(request, utime)) return;
  if (collects_) {
    problem_ = "request rejected: a scan is in progress";
    return;
  }
  if (sweep_.phase() == Phase::kApproach || sweep_.phase() == Phase::kSweep) {
    problem_ = "request rejected: a sweep is in progress";
    return;
  }
  if (sweep_.phase() == Phase::kReturn && request.laser != request_.laser) {
    problem_ = "request rejected: the other laser is not level yet";
    return;
  }
  if (!last_pose_) {
    problem_ = "request rejected: no pose received yet";
    return;
  }
  problem_.clear();
  request_ = request;
  scans_.clear();
  revolutions_.clear();
  tilt_rad_.clear();
  T_odom_body_.clear();
  z_odom_m_.clear();
  T_odom_body_.add(last_pose_->utime, last_pose_->T_odom_body);
  z_odom_m_.add(last_pose_->utime, last_pose_->z_odom_m);
  T_odom_begin_ = last_pose_->T_odom_body;
  utime_ = begin_utime_ = scan_utime_ = tilt_utime_ = utime;
  if (params_.lasers.lidar.present) {
    collects_ = true;
    gravity_.clear();  // the body may have braked just before
  } else {
    sweep_.begin();
  }
}

/// A request is repeated until its cloud arrives, which may be in transit.
bool ScanAssembly::is_repeat(const ScanRequest& request, std::int64_t utime) const {
  const bool same = request.id == request_.id && request.laser == request_.laser;
  if (!same || begin_utime_ == 0) return false;
  return is_busy() || seconds(utime - cloud_utime_) < kCloudInTransitS;
}

bool ScanAssembly::uses_laser(LaserId laser) const {
  return sweep_.phase() != Phase::kIdle && laser == request_.laser;
}

bool ScanAssembly::add(LaserId laser, const LaserScan& scan) {
  if (!uses_laser(laser)) return false;
  scan_utime_ = utime_;
  if (sweep_.phase() != Phase::kSweep) return false;
  if (!std::isfinite(scan.angle_min_rad) || !std::isfinite(scan.angle_step_rad)) return false;
  if (!scans_.empty() && scan.utime <= scans_.back().utime) return false;
  scans_.push_back(scan);
  return true;
}

bool ScanAssembly::add(LaserId laser, const TiltReading& reading) {
  if (!uses_laser(laser) || !std::isfinite(reading.angle_rad)) return false;
  tilt_utime_ = utime_;
  const bool newest = tilt_rad_.empty() || reading.utime > tilt_rad_.end_utime();
  if (!tilt_rad_.add(reading.utime, reading.angle_rad)) return false;
  if (newest) sweep_.add(reading);
  return true;
}

bool ScanAssembly::add(const ImuReading& reading) {
  imu_utime_ = utime_;
  return gravity_.add(reading);
}

bool ScanAssembly::has_imu() const {
  return imu_utime_ != 0 && seconds(utime_ - imu_utime_) < kImuTimeoutS;
}

bool ScanAssembly::add(const LidarRevolution& revolution) {
  if (!collects_ && has_imu()) passed_.add(revolution);
  if (!collects_ || revolution.columns.empty() || revolution.rings.empty()) return false;
  scan_utime_ = utime_;
  if (!revolutions_.empty() && revolution.utime <= revolutions_.back().utime) return false;
  revolutions_.push_back(revolution);
  if (revolutions_.size() > static_cast<std::size_t>(params_.revolutions)) {
    revolutions_.erase(revolutions_.begin());
  }
  return true;
}

bool ScanAssembly::add(std::int64_t utime, const Pose2& T_odom_body, double z_odom_m,
                       const Attitude& attitude) {
  if (!T_odom_body.vector().allFinite() || !std::isfinite(z_odom_m)) return false;
  last_pose_ = {utime, T_odom_body, z_odom_m, attitude};
  if (params_.lasers.lidar.present) passed_.add({utime, T_odom_body, z_odom_m, attitude});
  if (!is_busy() || !T_odom_body_.add(utime, T_odom_body)) return false;
  return z_odom_m_.add(utime, z_odom_m);
}

ScanAssembly::Step ScanAssembly::advance(std::int64_t utime) {
  utime_ = utime;
  if (collects_) return advance_collection(utime);
  Step step;
  if (sweep_.phase() == Phase::kIdle) return step;
  if (const std::string reason = abort_reason(utime); !reason.empty()) {
    step.cloud = abort_sweep(reason);
  }
  const Phase before = sweep_.phase();
  step.command = sweep_.advance(utime);
  if (before == Phase::kApproach && sweep_.phase() == Phase::kSweep) start_lines();
  if (before == Phase::kSweep && sweep_.phase() == Phase::kReturn) {
    step.cloud = assemble(true);
    cloud_utime_ = utime;
    if (!step.cloud) problem_ = "no scan received during the sweep";
  }
  return step;
}

ScanAssembly::Step ScanAssembly::advance_collection(std::int64_t utime) {
  Step step;
  const bool complete = revolutions_.size() >= static_cast<std::size_t>(params_.revolutions) &&
                        !waits_for_gravity(utime);
  const std::string reason = complete ? "" : collection_abort_reason(utime);
  if (!complete && reason.empty()) return step;
  measure_up();
  if (!reason.empty()) problem_ = reason;
  collects_ = false;
  cloud_utime_ = utime;
  step.cloud = assemble_revolutions(complete);
  return step;
}

bool ScanAssembly::waits_for_gravity(std::int64_t utime) const {
  const double since_reading_s = seconds(utime - std::max(imu_utime_, begin_utime_));
  return !gravity_.has_all_readings() && since_reading_s < kImuTimeoutS;
}

std::string ScanAssembly::collection_abort_reason(std::int64_t utime) const {
  if (seconds(utime - begin_utime_) > params_.timeout_s) return "the scan timed out";
  if (seconds(utime - scan_utime_) > params_.sensor_timeout_s) {
    return "revolutions of the spinning lidar timed out";
  }
  return has_moved() ? "the robot moved" : "";
}

bool ScanAssembly::has_moved() const {
  const Pose2 motion = between(T_odom_begin_, last_pose_->T_odom_body);
  return motion.translation().norm() > params_.moved_max_m ||
         std::abs(motion.theta) > params_.moved_max_rad;
}

std::string ScanAssembly::abort_reason(std::int64_t utime) const {
  const double timeout = sweep_.duration_s() + params_.timeout_s;
  if (sweep_.phase() == Phase::kReturn) {
    const bool late = seconds(utime - begin_utime_) > 2.0 * timeout;
    return late ? fmt::format("{} does not return to level", name_of(request_.laser)) : "";
  }
  if (seconds(utime - begin_utime_) > timeout) return "the sweep timed out";
  if (seconds(utime - scan_utime_) > params_.sensor_timeout_s) {
    return fmt::format("scans of {} timed out", name_of(request_.laser));
  }
  if (seconds(utime - tilt_utime_) > params_.sensor_timeout_s) {
    return fmt::format("tilt of {} timed out", name_of(request_.laser));
  }
  return has_moved() ? "the robot moved" : "";
}

std::optional<Cloud> ScanAssembly::abort_sweep(const std::string& reason) {
  problem_ = reason;
  if (sweep_.phase() == Phase::kReturn) {
    sweep_.stop();
    return std::nullopt;
  }
  const bool has_lines = sweep_.phase() == Phase::kSweep;
  sweep_.return_to_level();
  return has_lines ? assemble(false) : std::nullopt;
}

void ScanAssembly::start_lines() {
  scans_.clear();
  first_line_utime_ = tilt_rad_.end_utime();
  measure_up();
}

void ScanAssembly::measure_up() {
  const auto measured = gravity_.up_body();
  up_body_ = measured.value_or(last_pose_->attitude.up_body());
  if (!measured) problem_ = "no IMU readings at rest: levelled by the attitude of the pose";
}

const LaserMount& ScanAssembly::mount() const { return params_.lasers.of(request_.laser); }

Cloud ScanAssembly::empty_cloud(std::int64_t utime, bool complete) const {
  Cloud cloud;
  cloud.utime = utime;
  cloud.id = request_.id;
  cloud.complete = complete;
  cloud.T_odom_level = T_odom_body_.at(utime).value();
  cloud.z_odom_m = z_odom_m_.at(utime).value();
  return cloud;
}

std::optional<Cloud> ScanAssembly::assemble_revolutions(bool complete) {
  if (revolutions_.empty()) return std::nullopt;
  const LidarRevolution& last = revolutions_.back();
  const std::int64_t end_utime = last.utime_of(last.columns.size() - 1, last.rings.size() - 1);
  Cloud cloud = empty_cloud(end_utime, complete);
  const RingPlacement placement(params_.lasers, T_odom_body_, cloud.T_odom_level,
                                level_rotation(up_body_));
  for (const LidarRevolution& revolution : revolutions_) {
    RangeImage image = range_image(revolution, params_.lasers.front);
    remove_mixed_pixels(image, 1, params_.mixed_pixels);
    for (CloudLine& line : placement.place(revolution, image)) {
      cloud.lines.push_back(std::move(line));
    }
  }
  for (CloudLine& line : passed_.lines(cloud.T_odom_level, cloud.z_odom_m)) {
    cloud.lines.push_back(std::move(line));
  }
  passed_.clear();
  return cloud;
}

std::optional<Cloud> ScanAssembly::assemble(bool complete) const {
  if (scans_.empty()) return std::nullopt;
  Cloud cloud = empty_cloud(tilt_rad_.end_utime(), complete);
  const BeamPlacement placement(
      mount(), mount().timing,
      {tilt_rad_, T_odom_body_, cloud.T_odom_level, level_rotation(up_body_)});

  RangeImage image = range_image(scans_, mount());
  const int turns = mount().timing.turns(scans_.front().angle_step_rad);
  remove_mixed_pixels(image, turns, params_.mixed_pixels);
  for (std::size_t i = 0; i < scans_.size(); ++i) {
    // Scans before the first tilt or after the last one cannot be placed.
    if (scans_[i].utime < first_line_utime_) continue;
    if (placement.end_utime(scans_[i]) > cloud.utime) continue;
    cloud.lines.push_back(placement.place(scans_[i], image[i]));
  }
  if (cloud.lines.empty()) return std::nullopt;
  return cloud;
}

}  // namespace adit
