// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/scan_assembly/passed_revolutions.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

#include "procs/scan_assembly/beam_placement.hpp"
#include "procs/scan_assembly/ring_placement.hpp"

namespace adit {
namespace {

constexpr std::int64_t kPosesUs = 1'000'000;
constexpr double kStepMaxM = 1.0;               // between two poses
constexpr double kAttitudeChangeMaxRad = 0.01;  // during a revolution; 3 cm of height 3 m ahead

std::int64_t end_utime(const LidarRevolution& revolution) {
  return revolution.utime_of(revolution.columns.size() - 1, revolution.rings.size() - 1);
}

}  // namespace

void PassedRevolutions::add(const BodyPose& pose) {
  if (params_.count == 0) return;
  if (!poses_.empty()) {
    const BodyPose& last = poses_.back();
    const bool jumps = between(last.T_odom_body, pose.T_odom_body).translation().norm() > kStepMaxM;
    if (pose.utime <= last.utime || jumps) {
      poses_.clear();
      kept_.clear();
      pending_.reset();
      T_odom_last_.reset();
    }
  }
  poses_.push_back(pose);
  while (poses_.back().utime - poses_.front().utime > kPosesUs) poses_.pop_front();
  if (!T_odom_last_) T_odom_last_ = pose.T_odom_body;
  if (pending_ && end_utime(*pending_) <= pose.utime) place_pending();
}

bool PassedRevolutions::is_due() const {
  if (poses_.empty() || !T_odom_last_) return false;
  const Pose2 moved = between(*T_odom_last_, poses_.back().T_odom_body);
  return moved.translation().norm() >= params_.spacing_m ||
         std::abs(moved.theta) >= params_.spacing_rad;
}

void PassedRevolutions::add(const LidarRevolution& revolution) {
  if (params_.count == 0 || revolution.columns.empty() || revolution.rings.empty()) return;
  if (!pending_ && is_due()) pending_ = revolution;
}

void PassedRevolutions::place_pending() {
  const LidarRevolution revolution = std::move(*std::exchange(pending_, std::nullopt));
  InterpolationBuffer<Pose2> T_odom_body;
  double roll_min = 10.0, roll_max = -10.0, pitch_min = 10.0, pitch_max = -10.0;
  for (const BodyPose& pose : poses_) {
    T_odom_body.add(pose.utime, pose.T_odom_body);
    if (pose.utime < revolution.utime) continue;
    roll_min = std::min(roll_min, pose.attitude.roll_rad);
    roll_max = std::max(roll_max, pose.attitude.roll_rad);
    pitch_min = std::min(pitch_min, pose.attitude.pitch_rad);
    pitch_max = std::max(pitch_max, pose.attitude.pitch_rad);
  }
  const bool is_covered = poses_.front().utime <= revolution.utime;
  const bool is_steady = roll_max - roll_min <= kAttitudeChangeMaxRad &&
                         pitch_max - pitch_min <= kAttitudeChangeMaxRad;
  if (!is_covered || !is_steady) return;
  const BodyPose& end = poses_.back();
  const RingPlacement placement(lasers_, T_odom_body, end.T_odom_body, end.attitude.rotation());
  RangeImage image = range_image(revolution, lasers_.front);
  remove_mixed_pixels(image, 1, mixed_pixels_);
  kept_.push_back({end, placement.place(revolution, image)});
  T_odom_last_ = end.T_odom_body;
  if (kept_.size() > static_cast<std::size_t>(params_.count)) kept_.pop_front();
}

std::vector<CloudLine> PassedRevolutions::lines(const Pose2& T_odom_level, double z_odom_m) const {
  std::vector<CloudLine> lines;
  for (const Kept& kept : kept_) {
    Eigen::Isometry3d T = in_space(between(T_odom_level, kept.pose.T_odom_body));
    T.pretranslate(Eigen::Vector3d(0.0, 0.0, kept.pose.z_odom_m - z_odom_m));
    const Eigen::Isometry3f T_level_kept = T.cast<float>();
    for (CloudLine line : kept.lines) {
      line.origin = T_level_kept * line.origin;
      for (Eigen::Vector3f& p : line.points) p = T_level_kept * p;
      for (Eigen::Vector3f& miss : line.misses) miss = T_level_kept.linear() * miss;
      lines.push_back(std::move(line));
    }
  }
  return lines;
}

}  // namespace adit
