// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mission/traversed_path.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/journal/journal.hpp"
#include "common/types/planned_path.hpp"

namespace adit {
namespace {

constexpr double kSpacingM = 0.2;  // of poses; more than the pose noise of a standing robot
constexpr double kSpacingRad = 0.1;
// Tolerance of equal poses: half the distance of stored poses along the path, beside it the
// accuracy of driving.
constexpr double kSameAlongM = 0.15;
constexpr double kSameBesideM = 0.1;
constexpr double kSameRad = 0.1;
constexpr double kSameLevelM = 2.5;     // heights of the body on one level differ by less
constexpr double kNewestMapsM = 10.0;   // path length of the newest two local maps
constexpr std::size_t kRecentMax = 40;  // poses, 8 m
constexpr double kLateralMaxM = 1.0;    // of a route that follows the path
constexpr double kDetourMaxM = 2.0;     // of the path against the route, between two route points

bool is_same(const Pose2& T_odom_a, const Pose2& T_odom_b) {
  const Pose2 T_a_b = between(T_odom_a, T_odom_b);
  return std::abs(T_a_b.x) < kSameAlongM && std::abs(T_a_b.y) < kSameBesideM &&
         std::abs(T_a_b.theta) < kSameRad;
}

/// The poses from the newest on, over this path length at most.
template <class Poses>
std::vector<Pose2> backwards(const Pose2& T_odom_body, const Poses& poses, double length_m) {
  std::vector<Pose2> path{T_odom_body};
  double path_length_m = 0.0;
  for (auto pose = poses.rbegin(); pose != poses.rend() && path_length_m < length_m; ++pose) {
    path_length_m += (pose->translation() - path.back().translation()).norm();
    path.push_back(*pose);
  }
  return path;
}

struct PlanarRecord {  // as before heights were stored
  std::int64_t odom_epoch_utime = 0;
  std::array<double, 3> T_odom_body{};
  std::array<double, 3> T_map_odom{};
  std::int64_t has_map_pose = 0;  // as wide as the others: no padding
  std::int64_t anchored = 0;
};

struct Record {
  PlanarRecord planar;
  double z_odom_m = 0.0;
  double z_map_odom_m = 0.0;
};

std::array<double, 3> to_array(const Pose2& pose) { return {pose.x, pose.y, pose.theta}; }
Pose2 to_pose(const std::array<double, 3>& array) { return {array[0], array[1], array[2]}; }

}  // namespace

bool TraversedPath::add(std::int64_t utime, const Pose2& T_odom_body, double z_odom_m) {
  utime_ = utime;
  T_odom_body_ = T_odom_body;
  z_odom_m_ = z_odom_m;
  if (!poses_.empty()) {
    const Pose2 step = between(poses_.back(), T_odom_body);
    const double path_length_m = step.translation().norm();
    if (path_length_m < kSpacingM && std::abs(step.theta) < kSpacingRad) return false;
    distance_travelled_m_ += path_length_m;
  }
  const auto same = std::find_if(poses_.begin(), poses_.end(), [&](const Place& stored) {
    return std::abs(stored.z_m - z_odom_m) < kSameLevelM && is_same(stored, T_odom_body);
  });
  poses_.erase(same, poses_.end());
  poses_.push_back({T_odom_body, z_odom_m});
  recent_.push_back(T_odom_body);
  if (recent_.size() > kRecentMax) recent_.pop_front();
  return true;
}

void TraversedPath::reset(const std::optional<Pose2>& T_map_odom, double z_map_odom_m) {
  T_odom_body_.reset();
  recent_.clear();
  if (T_map_odom) {
    for (const Place& place : poses_)
      previous_map_poses_.push_back({*T_map_odom * place, z_map_odom_m + place.z_m});
  }
  poses_.clear();
}

void TraversedPath::anchor(const Pose2& T_map_odom, double z_map_odom_m) {
  const Pose2 T_odom_map = T_map_odom.inverse();
  std::vector<Place> previous;
  for (const Place& place : previous_map_poses_)
    previous.push_back({T_odom_map * place, place.z_m - z_map_odom_m});
  poses_.insert(poses_.begin(), previous.begin(), previous.end());
  previous_map_poses_.clear();
}

void TraversedPath::correct(const Pose2& T_after_before, double z_after_before_m) {
  double path_length_m = 0.0;
  for (std::size_t i = poses_.size(); i-- > 0;) {
    if (i + 1 < poses_.size())
      path_length_m += (poses_[i].translation() - poses_[i + 1].translation()).norm();
    if (path_length_m > kNewestMapsM)
      poses_[i] = {T_after_before * poses_[i], z_after_before_m + poses_[i].z_m};
  }
}

std::vector<Pose2> TraversedPath::back(double length_m) const {
  if (!T_odom_body_) return {};
  return backwards(*T_odom_body_, poses_, length_m);
}

std::vector<Pose2> TraversedPath::recent(double length_m) const {
  if (!T_odom_body_) return {};
  return backwards(*T_odom_body_, recent_, length_m);
}

double TraversedPath::back_length_m(double length_m) const {
  return length_of_path_m(back(length_m));
}

double length_of_path_m(const std::vector<Pose2>& path) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i)
    length_m += (path[i].translation() - path[i - 1].translation()).norm();
  return length_m;
}

std::vector<Pose2> TraversedPath::poses_back_within(double distance_m) const {
  if (!T_odom_body_) return {};
  std::vector<Pose2> path{*T_odom_body_};
  const Eigen::Vector2d p_odom_body = T_odom_body_->translation();
  for (auto pose = poses_.rbegin(); pose != poses_.rend(); ++pose) {
    if (path.size() == PlanGoal::kPointsMax) break;
    if (std::abs(pose->z_m - z_odom_m_) >= kSameLevelM) continue;
    if ((pose->translation() - p_odom_body).norm() <= distance_m) path.push_back(*pose);
  }
  return path;
}

double TraversedPath::shared_length_m(const std::vector<Eigen::Vector2d>& route_odom) const {
  double shared_length_m = 0.0;
  auto nearest = poses_.rbegin();
  for (std::size_t i = 1; i < route_odom.size() && nearest != poses_.rend(); ++i) {
    const auto lateral_m = [&](const Pose2& pose) {
      return (pose.translation() - route_odom[i]).norm();
    };
    const double leg_m = (route_odom[i] - route_odom[i - 1]).norm();
    const auto ahead = static_cast<std::ptrdiff_t>((leg_m + kDetourMaxM) / kSpacingM);
    const auto end = nearest + std::min(ahead, poses_.rend() - nearest);
    nearest = std::min_element(
        nearest, end, [&](const Pose2& a, const Pose2& b) { return lateral_m(a) < lateral_m(b); });
    if (lateral_m(*nearest) > kLateralMaxM) break;
    shared_length_m += leg_m;
  }
  return shared_length_m;
}

std::vector<std::uint8_t> to_bytes(const StoredPathPose& pose) {
  const Record record{{pose.odom_epoch_utime, to_array(pose.T_odom_body),
                       to_array(pose.T_map_odom.value_or(Pose2{})),
                       pose.T_map_odom.has_value() ? 1 : 0, pose.anchored ? 1 : 0},
                      pose.z_odom_m,
                      pose.z_map_odom_m};
  const auto bytes = bytes_of(record);
  return {bytes.begin(), bytes.end()};
}

std::optional<StoredPathPose> stored_path_pose_from(std::span<const std::uint8_t> bytes) {
  auto record = value_from_bytes<Record>(bytes);
  if (const auto planar = value_from_bytes<PlanarRecord>(bytes)) record = Record{*planar};
  if (!record) return std::nullopt;
  const PlanarRecord& planar = record->planar;
  StoredPathPose pose{
      planar.odom_epoch_utime, to_pose(planar.T_odom_body), {}, planar.anchored != 0,
      record->z_odom_m,        record->z_map_odom_m};
  if (planar.has_map_pose != 0) pose.T_map_odom = to_pose(planar.T_map_odom);
  return pose;
}

TraversedPath traversed_path_from(const std::vector<StoredPathPose>& poses) {
  TraversedPath path;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const StoredPathPose& pose = poses[i];
    const StoredPathPose* before = i > 0 ? &poses[i - 1] : nullptr;
    if (before != nullptr && pose.odom_epoch_utime != before->odom_epoch_utime) {
      path.reset(before->T_map_odom, before->z_map_odom_m);
    } else if (before != nullptr && pose.T_map_odom && before->T_map_odom &&
               *pose.T_map_odom != *before->T_map_odom) {
      path.correct(between(*pose.T_map_odom, *before->T_map_odom),
                   before->z_map_odom_m - pose.z_map_odom_m);
    }
    if (pose.anchored && pose.T_map_odom) path.anchor(*pose.T_map_odom, pose.z_map_odom_m);
    path.add(0, pose.T_odom_body, pose.z_odom_m);
  }
  return path;
}

}  // namespace adit
