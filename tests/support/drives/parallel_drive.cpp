// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/drives/parallel_drive.hpp"

#include <algorithm>
#include <utility>

#include "common/geometry/pose2.hpp"

namespace adit::test {
namespace {

constexpr const char* kChannel = "LASER_FRONT";

SampleParams drive_params(double yaw_bias_deg_per_m) {
  SampleParams params;
  params.world = "parallel";
  params.turn_bias_rad_per_m = deg_to_rad(yaw_bias_deg_per_m);
  return params;
}

MappingParams params(const DisplacementErrorParams& assumed_error) {
  MappingParams params;
  params.local_maps.error = assumed_error;
  return params;
}

bool is_accepted(int chosen) { return chosen != Association::kNone; }

}  // namespace

ParallelDrive::ParallelDrive(double yaw_bias_deg_per_m,
                             const DisplacementErrorParams& assumed_error)
    : run_(drive_params(yaw_bias_deg_per_m)), params_(params(assumed_error)) {
  mapping_.emplace(params_);
}

void ParallelDrive::restart(StoredMap stored) {
  mapping_.emplace(params_);
  mapping_->restore(std::move(stored));
}

DisplacementErrorParams ParallelDrive::drifting_odometry_error() {
  DisplacementErrorParams error;
  error.drift_rad_per_sqrt_m = 0.006;
  error.drift_m_per_sqrt_m = 0.02;
  return error;
}

std::optional<MapUpdate> ParallelDrive::next() {
  while (const auto reading = run_.next()) {
    if (auto update =
            mapping_->add(kChannel, reading->scan, match_from_odometry(reading->odometry))) {
      return update;
    }
  }
  if (ended_) return std::nullopt;
  ended_ = true;
  return mapping_->finish();
}

/// A scan match whose pose is that of the wheel odometry.
ScanMatch ParallelDrive::match_from_odometry(const WheelOdometry& odometry) {
  ScanMatch match;
  match.utime = odometry.utime;
  match.channel = kChannel;
  match.status = last_ ? ScanMatch::Status::kMatched : ScanMatch::Status::kFirstScan;
  match.T_odom_body = odometry.T_wheel_body;
  if (last_) {
    match.reference_utime = last_->utime;
    match.T_reference_body = between(last_->T_wheel_body, odometry.T_wheel_body);
  }
  match.covariance = 1e-6 * Eigen::Matrix3d::Identity();
  last_ = odometry;
  return match;
}

double ParallelDrive::newest_error_m() const {
  const auto& maps = mapping_->local_maps();
  const std::vector<Pose2> poses = mapping_->graph().poses;
  const Pose2 found = between(poses.front(), poses.back());
  const Pose2 truth = between(*interpolate(run_.truth(), maps.front().utime),
                              *interpolate(run_.truth(), maps.back().utime));
  return (found.translation() - truth.translation()).norm();
}

PathError ParallelDrive::error() const {
  const std::vector<Pose2> poses = mapping_->graph().poses;
  Trajectory trajectory;
  for (const LocalMap& map : mapping_->local_maps().headers()) {
    trajectory.push_back({map.utime, poses[static_cast<std::size_t>(map.id)]});
  }
  return path_error(trajectory, run_.truth());
}

int revoked(const MapUpdate& update) {
  return static_cast<int>(std::ranges::count_if(update.associations, [](const Association& a) {
    return is_accepted(a.previously_chosen) && a.chosen != a.previously_chosen;
  }));
}

int newly_accepted(const MapUpdate& update) {
  return static_cast<int>(std::ranges::count_if(update.associations, [](const Association& a) {
    return is_accepted(a.chosen) && a.chosen != a.previously_chosen;
  }));
}

}  // namespace adit::test
