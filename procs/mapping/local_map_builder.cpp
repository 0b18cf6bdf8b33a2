// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/local_map_builder.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include <Eigen/LU>

#include "common/sensing/motion_correction.hpp"
#include "common/sensing/seconds.hpp"

namespace adit {
namespace {

constexpr double kSlowestS = 0.5;  // between two scans of which the motion is a velocity

/// Of (x, y, θ) in the body frame, by the motion since the scan before.
Eigen::Vector3d velocity(const ScanMatch& match) {
  const double duration_s = seconds(match.utime - match.reference_utime);
  const bool is_known = match.reference_utime != 0 && duration_s > 0.0 && duration_s < kSlowestS;
  if (!is_known) return Eigen::Vector3d::Zero();
  return match.T_reference_body.vector() / duration_s;
}

}  // namespace

LocalMapBuilder::LocalMapBuilder(const LocalMapBuilderParams& params, LaserMounts mounts,
                                 int first_id, int session)
    : params_(params), mounts_(std::move(mounts)), error_(params.error) {
  map_.id = first_id;
  map_.session = session;
  continues_ = session > 0;
}

std::optional<LocalMap> LocalMapBuilder::add(const std::string& channel, const LaserScan& scan,
                                             const ScanMatch& match) {
  if (match.status == ScanMatch::Status::kRejected) return std::nullopt;
  const bool first = match.status == ScanMatch::Status::kFirstScan && match.reference_utime == 0;
  const bool new_odom =
      first || (odom_epoch_utime_ && *odom_epoch_utime_ != match.odom_epoch_utime);
  odom_epoch_utime_ = match.odom_epoch_utime;
  std::optional<LocalMap> finished;
  if (new_odom) finished = finish();

  const std::optional<Pose2> wheels_step = wheels_.step_to(match.utime);
  if (map_.scans.empty()) {
    if (match.status == ScanMatch::Status::kLost) return finished;
    begin(match.T_odom_body);
  } else {
    error_.add_step(between(T_odom_body_, match.T_odom_body), match, wheels_step);
  }
  T_odom_body_ = match.T_odom_body;
  if (match.status == ScanMatch::Status::kLost) return finished;
  const bool due = first_map_due(scan.utime) || split_due();
  if (!due && !moved_enough(channel, T_odom_body_)) return finished;
  store_scan(channel, scan, match);
  if (!due && distance_travelled_m_ < params_.length_m && turn_rad_ < params_.turn_max_rad)
    return finished;

  finished = end();
  begin(T_odom_body_);
  store_scan(channel, scan, match);
  return finished;
}

std::optional<LocalMap> LocalMapBuilder::finish() {
  if (map_.scans.empty()) return std::nullopt;
  LocalMap finished = std::move(map_);
  map_ = {};
  withheld_.clear();
  map_.id = finished.id + 1;
  map_.session = finished.session + 1;
  continues_ = true;
  return finished;
}

/// From one place a surface ahead looks the same whether it is ground or a wall.
void LocalMapBuilder::expect_ground() {
  if (std::exchange(sees_ground_, true) || distance_travelled_m_ >= params_.split_min_m) return;
  for (std::size_t i = 0; i < withheld_.size(); ++i) {
    map_.scans[i].unconfirmed_beams = std::move(withheld_[i]);
  }
}

void LocalMapBuilder::replace_last_map(const UncertainPose& T_before_last,
                                       const LocalMap& discarded) {
  scale_errors_.erase(map_.id);
  --map_.id;
  scale_errors_.erase(map_.id);
  const UncertainPose T_last_local{map_.T_previous_local, map_.information.inverse()};
  const UncertainPose T_before_local = T_before_last * T_last_local;
  map_.T_previous_local = T_before_local.T_from_to;
  map_.information = T_before_local.covariance.inverse();
  map_.climb_m += discarded.climb_m;
  map_.forward_m += discarded.forward_m;
}

bool LocalMapBuilder::first_map_due(std::int64_t utime) const {
  return continues_ && params_.first_s > 0.0 && !map_.scans.empty() &&
         seconds(utime - map_.utime) >= params_.first_s;
}

/// Where the body stands, not where it stored its last scan.
bool LocalMapBuilder::split_due() {
  if (!std::exchange(due_, false) || map_.scans.empty()) return false;
  const double moved_m = between(T_odom_stored_, T_odom_body_).translation().norm();
  return distance_travelled_m_ + moved_m >= params_.split_min_m;
}

bool LocalMapBuilder::moved_enough(const std::string& channel, const Pose2& T_odom_body) const {
  const auto last = last_stored_.find(channel);
  if (last == last_stored_.end()) return true;
  const Pose2 moved = between(last->second, T_odom_body);
  return moved.translation().norm() >= params_.keyframe_distance_m ||
         std::abs(moved.theta) >= params_.keyframe_angle_rad;
}

/// Without ground, and as if all beams were measured at one time.
LocalScan LocalMapBuilder::local_scan(const std::string& channel, const LaserScan& scan,
                                      const ScanMatch& match) const {
  const Pose2 T_local_body =
      map_.scans.empty() ? Pose2{} : between(map_.T_odom_local, match.T_odom_body);
  LocalScan stored{channel,
                   scan,
                   T_local_body,
                   match.z_m - map_.z_odom_m,
                   match.attitude,
                   match.unconfirmed_beams,
                   match.attitude_from_ground};
  for (const std::int32_t beam : match.ground_beams) {
    const auto i = static_cast<std::size_t>(beam);
    if (i < stored.scan.ranges_m.size()) stored.scan.ranges_m[i] = 0.0F;
  }
  const auto mount = mounts_.find(channel);
  if (mount == mounts_.end()) return stored;
  StillScan still = without_motion(stored.scan, mount->second, velocity(match));
  if (still.beam_of.empty()) return stored;
  stored.scan = std::move(still.scan);
  stored.unconfirmed_beams.clear();
  for (std::size_t beam = 0; beam < still.beam_of.size(); ++beam) {
    if (std::ranges::binary_search(match.unconfirmed_beams, still.beam_of[beam]))
      stored.unconfirmed_beams.push_back(static_cast<std::int32_t>(beam));
  }
  return stored;
}

void LocalMapBuilder::store_scan(const std::string& channel, const LaserScan& scan,
                                 const ScanMatch& match) {
  const Pose2& T_odom_body = match.T_odom_body;
  const Pose2 moved = between(T_odom_stored_, T_odom_body);
  const double distance = moved.translation().norm();
  error_.add_travel(distance, moved.theta);
  distance_travelled_m_ += distance;
  forward_m_ += moved.x;
  turn_rad_ += std::abs(moved.theta);
  T_odom_stored_ = T_odom_body;
  last_stored_[channel] = T_odom_body;
  map_.end_utime = scan.utime;
  if (map_.scans.empty()) {
    map_.utime = scan.utime;
    map_.T_odom_local = T_odom_body;
    map_.z_odom_m = match.z_m;
  }
  map_.scans.push_back(local_scan(channel, scan, match));
  if (!sees_ground_) withheld_.push_back(std::exchange(map_.scans.back().unconfirmed_beams, {}));
}

void LocalMapBuilder::begin(const Pose2& T_odom_local) {
  T_odom_stored_ = T_odom_local;
  last_stored_.clear();
  withheld_.clear();
  distance_travelled_m_ = 0.0;
  forward_m_ = 0.0;
  turn_rad_ = 0.0;
  error_.reset();
}

LocalMap LocalMapBuilder::end() {
  continues_ = false;
  LocalMap finished = std::move(map_);
  map_ = {};
  map_.id = finished.id + 1;
  map_.session = finished.session;
  map_.T_previous_local = between(finished.T_odom_local, T_odom_body_);
  map_.information = error_.covariance().inverse();
  const WheelScaleError scale_error = error_.wheel_scale_error();
  if (scale_error.scale_sd > 0.0) scale_errors_[map_.id] = scale_error;
  map_.climb_m = finished.scans.back().z_m;
  map_.forward_m = forward_m_;
  return finished;
}

}  // namespace adit
