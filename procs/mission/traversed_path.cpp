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

constexpr double kSpacingM = 0.2;  // of places; standing is no way
constexpr double kSpacingRad = 0.1;
// Of poses that are the same: half-way to the next place along them, and beside them as far as a
// path is followed.
constexpr double kSameAlongM = 0.15;
constexpr double kSameBesideM = 0.1;
constexpr double kSameRad = 0.1;
constexpr double kLateralMaxM = 1.0;  // of a route that keeps to the track
constexpr double kDetourMaxM = 2.0;   // that the track may take than the route, from place to place

bool is_same(const Pose2& T_odom_a, const Pose2& T_odom_b) {
  const Pose2 T_a_b = between(T_odom_a, T_odom_b);
  return std::abs(T_a_b.x) < kSameAlongM && std::abs(T_a_b.y) < kSameBesideM &&
         std::abs(T_a_b.theta) < kSameRad;
}

}  // namespace

bool TraversedPath::add(std::int64_t utime, const Pose2& T_odom_body) {
  utime_ = utime;
  T_odom_body_ = T_odom_body;
  if (!poses_.empty()) {
    const Pose2 step = between(poses_.back(), T_odom_body);
    const double path_length_m = step.translation().norm();
    if (path_length_m < kSpacingM && std::abs(step.theta) < kSpacingRad) return false;
    distance_travelled_m_ += path_length_m;
  }
  const auto before = std::find_if(poses_.begin(), poses_.end(), [&](const Pose2& T_odom_place) {
    return is_same(T_odom_place, T_odom_body);
  });
  poses_.erase(before, poses_.end());
  poses_.push_back(T_odom_body);
  return true;
}

void TraversedPath::reset(const std::optional<Pose2>& T_map_odom) {
  T_odom_body_.reset();
  if (T_map_odom) {
    for (const auto& place : poses_) previous_map_poses_.push_back(*T_map_odom * place);
  }
  poses_.clear();
}

void TraversedPath::anchor(const Pose2& T_map_odom) {
  const Pose2 T_odom_map = T_map_odom.inverse();
  std::vector<Pose2> before;
  for (const Pose2& T_map_place : previous_map_poses_) before.push_back(T_odom_map * T_map_place);
  poses_.insert(poses_.begin(), before.begin(), before.end());
  previous_map_poses_.clear();
}

std::vector<Pose2> TraversedPath::back(double length_m) const {
  if (!T_odom_body_) return {};
  std::vector<Pose2> path{*T_odom_body_};
  double path_length_m = 0.0;
  for (auto place = poses_.rbegin(); place != poses_.rend() && path_length_m < length_m; ++place) {
    path_length_m += (place->translation() - path.back().translation()).norm();
    path.push_back(*place);
  }
  return path;
}

double TraversedPath::back_length_m(double length_m) const {
  const std::vector<Pose2> path = back(length_m);
  double path_length_m = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    path_length_m += (path[i].translation() - path[i - 1].translation()).norm();
  }
  return path_length_m;
}

std::vector<Pose2> TraversedPath::poses_back_within(double distance_m) const {
  if (!T_odom_body_) return {};
  std::vector<Pose2> path{*T_odom_body_};
  const Eigen::Vector2d p_body = T_odom_body_->translation();
  for (auto place = poses_.rbegin(); place != poses_.rend(); ++place) {
    if (path.size() == PlanGoal::kPointsMax) break;
    if ((place->translation() - p_body).norm() <= distance_m) path.push_back(*place);
  }
  return path;
}

double TraversedPath::shared_length_m(const std::vector<Eigen::Vector2d>& route_odom) const {
  double shared_length_m = 0.0;
  auto nearest = poses_.rbegin();
  for (std::size_t i = 1; i < route_odom.size() && nearest != poses_.rend(); ++i) {
    const auto lateral_m = [&](const Pose2& place) {
      return (place.translation() - route_odom[i]).norm();
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

namespace {

struct Record {
  std::int64_t odom_epoch_utime = 0;
  std::array<double, 3> T_odom_body{};
  std::array<double, 3> T_map_odom{};
  std::int64_t has_map_pose = 0;  // as wide as the others, so that all bytes mean something
  std::int64_t anchored = 0;
};

std::array<double, 3> to_array(const Pose2& pose) { return {pose.x, pose.y, pose.theta}; }
Pose2 pose(const std::array<double, 3>& to_array) {
  return {to_array[0], to_array[1], to_array[2]};
}

}  // namespace

std::vector<std::uint8_t> to_bytes(const StoredPathPose& place) {
  const Record record{place.odom_epoch_utime, to_array(place.T_odom_body),
                      to_array(place.T_map_odom.value_or(Pose2{})),
                      place.T_map_odom.has_value() ? 1 : 0, place.anchored ? 1 : 0};
  const auto bytes = bytes_of(record);
  return {bytes.begin(), bytes.end()};
}

std::optional<StoredPathPose> stored_path_pose_from(std::span<const std::uint8_t> bytes) {
  const auto record = value_from_bytes<Record>(bytes);
  if (!record) return std::nullopt;
  StoredPathPose place{
      record->odom_epoch_utime, pose(record->T_odom_body), {}, record->anchored != 0};
  if (record->has_map_pose != 0) place.T_map_odom = pose(record->T_map_odom);
  return place;
}

TraversedPath traversed_path_from(const std::vector<StoredPathPose>& places) {
  TraversedPath track;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (i > 0 && places[i].odom_epoch_utime != places[i - 1].odom_epoch_utime) {
      track.reset(places[i - 1].T_map_odom);
    }
    if (places[i].anchored && places[i].T_map_odom) track.anchor(*places[i].T_map_odom);
    track.add(0, places[i].T_odom_body);
  }
  return track;
}

}  // namespace adit
