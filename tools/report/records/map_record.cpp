// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/records/map_record.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "common/bus/channels.hpp"
#include "common/bus/typed_messages.hpp"

namespace adit {
namespace {

constexpr std::size_t kQueued = 1000;
constexpr double kStepM = 0.05;
constexpr double kStepRad = 0.02;
constexpr std::int64_t kStepUs = 1'000'000;

/// Appends a pose. The last pose is always kept; it is replaced until it is a step away from the
/// previous one.
void append_thinned(const StampedPose& pose, Trajectory& poses) {
  if (!poses.empty() && pose.utime <= poses.back().utime) return;
  if (poses.size() > 1) {
    const TimedPose& previous = poses[poses.size() - 2];
    const Pose2 step = between(previous.pose, pose.T_odom_body);
    const bool is_step = step.translation().norm() >= kStepM || std::abs(step.theta) >= kStepRad ||
                         pose.utime - previous.utime >= kStepUs;
    if (!is_step) poses.pop_back();
  }
  poses.push_back({pose.utime, pose.T_odom_body, pose.z_m});
}

}  // namespace

MapRecord::MapRecord(Bus& bus) {
  subscription_.subscribe(
      bus, {.on_local_map =
                [this](LocalMap map) {
                  const int id = map.id;
                  local_maps_.insert_or_assign(id, std::move(map));
                },
            .on_graph = [this](MapGraph graph) { graph_ = std::move(graph); },
            .on_association = [this](const Association& a) { on_association(a); },
            .on_contradictions =
                [this](MapContradictions found) { contradictions_ = std::move(found.pairs); }});
  subscribe<pose_t>(bus, channels::kPose, Delivery::queued(kQueued),
                    [this](const StampedPose& pose) { append_thinned(pose, odometry_); });
  subscribe<pose_t>(bus, channels::kTruth, Delivery::queued(kQueued),
                    [this](const StampedPose& pose) { append_thinned(pose, truth_); });
}

void MapRecord::on_association(const Association& association) {
  const bool known =
      std::find(associations_.begin(), associations_.end(), association) != associations_.end();
  if (!known) associations_.push_back(association);
}

std::vector<LocalMap> MapRecord::release_local_maps() {
  std::vector<LocalMap> maps;
  for (auto& [id, map] : local_maps_) maps.push_back(std::move(map));
  local_maps_.clear();
  return maps;
}

}  // namespace adit
