// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/records/map_record.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "common/bus/channels.hpp"
#include "common/bus/typed_messages.hpp"

namespace adit {
namespace {

constexpr std::size_t kQueued = 1000;
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
                    [this](const StampedPose& pose) {
                      odometry_.add({pose.utime, pose.T_odom_body, pose.z_m});
                    });
  subscribe<pose_t>(bus, channels::kTruth, Delivery::queued(kQueued),
                    [this](const StampedPose& pose) {
                      truth_.add({pose.utime, pose.T_odom_body, pose.z_m});
                    });
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
