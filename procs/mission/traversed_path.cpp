// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mission/traversed_path.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "common/journal/journal.hpp"
#include "common/pose_graph/map_correction.hpp"
#include "common/types/planned_path.hpp"

namespace adit {
namespace {

constexpr double kSpacingM = 0.2;  // of poses; more than the pose noise of a standing robot
constexpr double kSpacingRad = 0.1;
constexpr std::size_t kRecentMax = 40;  // poses, 8 m

/// From a pose over those of the elements from `next` on, over this path length or just beyond.
template <class Element, class PoseOf>
std::vector<Pose2> path_over(const Pose2& T_odom_start, Element next, Element end, double length_m,
                             const PoseOf& pose_of) {
  std::vector<Pose2> path{T_odom_start};
  double path_length_m = 0.0;
  for (; next != end && path_length_m < length_m; ++next) {
    const Pose2& pose = pose_of(*next);
    path_length_m += (pose.translation() - path.back().translation()).norm();
    path.push_back(pose);
  }
  return path;
}

const Pose2& itself(const Pose2& pose) { return pose; }

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
  if (!trail_.empty()) {
    const Pose2 step = between(ground_.pose(trail_.back()), T_odom_body);
    const double path_length_m = step.translation().norm();
    if (path_length_m < kSpacingM && std::abs(step.theta) < kSpacingRad) return false;
    distance_travelled_m_ += path_length_m;
  }
  const DrivenPose pose{T_odom_body, z_odom_m};
  const auto same = std::ranges::find_if(
      trail_, [&](std::size_t node) { return is_same(ground_.pose(node), pose); });
  const bool is_on_trail = same != trail_.end();
  const std::size_t node = is_on_trail ? *same : ground_.add(pose, distance_travelled_m_);
  if (is_on_trail) ground_.update(node, pose, distance_travelled_m_);
  if (!trail_.empty()) ground_.connect(trail_.back(), node);
  trail_.erase(same, trail_.end());
  trail_.push_back(node);
  recent_.push_back(T_odom_body);
  if (recent_.size() > kRecentMax) recent_.pop_front();
  return true;
}

void TraversedPath::reset(const std::optional<Pose2>& T_map_odom, double z_map_odom_m) {
  T_odom_body_.reset();
  recent_.clear();
  if (T_map_odom) {
    ground_.move(*T_map_odom, z_map_odom_m);
    prepend_previous();
    previous_ground_ = std::move(ground_);
    previous_trail_ = std::move(trail_);
  }
  ground_ = {};
  trail_.clear();
}

void TraversedPath::anchor(const Pose2& T_map_odom, double z_map_odom_m) {
  previous_ground_.move(T_map_odom.inverse(), -z_map_odom_m);
  prepend_previous();
}

/// In the frame of the present ground. The robot is taken to have stood between both.
void TraversedPath::prepend_previous() {
  ground_.prepend(previous_ground_);
  for (std::size_t& node : trail_) node += previous_ground_.size();
  if (!previous_trail_.empty() && !trail_.empty())
    ground_.connect(previous_trail_.back(), trail_.front());
  trail_.insert(trail_.begin(), previous_trail_.begin(), previous_trail_.end());
  previous_ground_ = {};
  previous_trail_.clear();
}

void TraversedPath::correct(const Pose2& T_after_before, double z_after_before_m) {
  ground_.move(T_after_before, z_after_before_m, distance_travelled_m_ - kKeepsPlaceInOdomM);
}

std::vector<Pose2> TraversedPath::back(double length_m) const {
  if (!T_odom_body_) return {};
  return path_over(*T_odom_body_, trail_.rbegin(), trail_.rend(), length_m,
                   [&](std::size_t node) -> const Pose2& { return ground_.pose(node); });
}

std::vector<Pose2> TraversedPath::recent(double length_m) const {
  if (!T_odom_body_) return {};
  return path_over(*T_odom_body_, recent_.rbegin(), recent_.rend(), length_m, itself);
}

double TraversedPath::back_length_m(double length_m) const {
  return length_of_path_m(back(length_m));
}

std::vector<Pose2> first_part_of(const std::vector<Pose2>& path, double length_m) {
  return path_over(path.front(), path.begin() + 1, path.end(), length_m, itself);
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
  for (auto node = trail_.rbegin(); node != trail_.rend(); ++node) {
    const DrivenPose& pose = ground_.pose(*node);
    if (path.size() == PlanGoal::kPointsMax) break;
    if (!is_same_level(pose.z_m, z_odom_m_)) continue;
    if ((pose.translation() - p_odom_body).norm() <= distance_m) path.push_back(pose);
  }
  return path;
}

double TraversedPath::shared_length_m(const std::vector<Eigen::Vector2d>& route_odom) const {
  if (trail_.empty()) return 0.0;
  DrivenGraph::PathOptions options;
  options.among.emplace(trail_.begin(), trail_.end());
  return ground_.along(trail_.back(), route_odom, options).shared_m;
}

/// The newest stored pose may lie behind the body on the path: going there first would be a detour.
TraversedPath::KnownPart TraversedPath::known_part(const std::vector<Eigen::Vector2d>& route_odom,
                                                   bool may_reverse) const {
  if (!T_odom_body_ || trail_.empty()) return {};
  const GraphPath path = ground_.along(trail_.back(), route_odom, {may_reverse, {}});
  KnownPart known{path.shared_m, {*T_odom_body_}};
  for (const std::size_t node : path.nodes) known.path_odom.push_back(ground_.pose(node));
  if (known.path_odom.size() > 2) {
    const auto distance_m = [&](std::size_t a, std::size_t b) {
      return (known.path_odom[a].translation() - known.path_odom[b].translation()).norm();
    };
    if (distance_m(0, 2) <= distance_m(1, 2)) known.path_odom.erase(known.path_odom.begin() + 1);
  }
  if (known.path_odom.size() > PlanGoal::kPointsMax) known.path_odom.resize(PlanGoal::kPointsMax);
  return known;
}

/// With the end of the robot ahead that leads along the route now, or its front if it must.
TraversedPath::KnownPart TraversedPath::joined_part(const std::vector<Eigen::Vector2d>& route_odom,
                                                    double join_m, bool may_reverse,
                                                    bool is_symmetric) const {
  if (!T_odom_body_ || route_odom.size() < 2) return {};
  const GraphPath path = ground_.joining(route_odom, join_m, z_odom_m_);
  if (path.nodes.size() < 2) return {};
  const auto leads = [](const Pose2& T_odom, const Eigen::Vector2d& p_odom) {
    return (T_odom.inverse() * p_odom).x() >= 0.0;
  };
  const bool front_leads = !may_reverse || leads(*T_odom_body_, route_odom[1]);
  const bool front_led =
      leads(ground_.pose(path.nodes[0]), ground_.pose(path.nodes[1]).translation());
  if (front_leads != front_led && !is_symmetric) return {};
  const Pose2 turn{0.0, 0.0, front_leads == front_led ? 0.0 : std::numbers::pi};
  KnownPart known{path.shared_m, {}};
  for (const std::size_t node : path.nodes) {
    const Pose2 pose = ground_.pose(node) * turn;
    const bool is_backwards =
        !known.path_odom.empty() && !leads(known.path_odom.back(), pose.translation());
    if (is_backwards && !may_reverse) return {};
    known.path_odom.push_back(pose);
    if (known.path_odom.size() == PlanGoal::kPointsMax) break;
  }
  return known;
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
