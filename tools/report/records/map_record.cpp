// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/records/map_record.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/bus/channels.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/mapping/association.hpp"

namespace adit {
namespace {

constexpr std::size_t kWaiting = 1000;
constexpr double kStepM = 0.05;
constexpr double kStepRad = 0.02;
constexpr std::int64_t kStepUs = 1'000'000;

/// The last pose of all is kept too: it is replaced until a step is done.
void append_thinned(const StampedPose& pose, Trajectory& poses) {
  if (!poses.empty() && pose.utime <= poses.back().utime) return;
  if (poses.size() > 1) {
    const TimedPose& stored = poses[poses.size() - 2];
    const Pose2 step = between(stored.pose, pose.T_odom_body);
    const bool is_step = step.translation().norm() >= kStepM || std::abs(step.theta) >= kStepRad ||
                         pose.utime - stored.utime >= kStepUs;
    if (!is_step) poses.pop_back();
  }
  poses.push_back({pose.utime, pose.T_odom_body});
}

}  // namespace

MapRecord::MapRecord(Bus& bus) {
  subscribe<local_map_t>(bus, channels::kLocalMap, Delivery::queued(kWaiting),
                         [this](const LocalMapFragment& fragment) {
                           if (auto map = local_map_fragments_.add(fragment)) {
                             const int id = map->id;
                             local_maps_.insert_or_assign(id, std::move(*map));
                           }
                         });
  subscribe<pose_graph_t>(bus, channels::kPoseGraph, Delivery::queued(kWaiting),
                          [this](const PoseGraphFragment& fragment) {
                            if (auto graph = graph_fragments_.add(fragment))
                              graph_ = std::move(graph);
                          });
  subscribe<association_t>(bus, channels::kAssociation, Delivery::queued(kWaiting),
                           [this](const Association& association) { on_association(association); });
  subscribe<pose_t>(bus, channels::kPose, Delivery::queued(kWaiting),
                    [this](const StampedPose& pose) { append_thinned(pose, odometry_); });
  subscribe<pose_t>(bus, channels::kTruth, Delivery::queued(kWaiting),
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
