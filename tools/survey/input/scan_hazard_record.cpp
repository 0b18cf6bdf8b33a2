// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/input/scan_hazard_record.hpp"

#include <cstddef>
#include <iterator>
#include <utility>

#include "common/bus/channels.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/navigation.hpp"
#include "common/messages/sensing.hpp"
#include "common/records/terrain_hazards.hpp"

namespace adit {
namespace {

constexpr std::size_t kQueuedMessages = 1000;

}  // namespace

ScanHazardRecord::ScanHazardRecord(Bus& bus, const Vehicle& vehicle,
                                   const std::filesystem::path& scratch)
    : clouds_(scratch) {
  const Delivery all = Delivery::queued(kQueuedMessages);
  subscribe<pose_t>(bus, channels::kPose, all, [this](const StampedPose& pose) { pose_ = pose; });
  subscribe<cloud_t>(bus, channels::kCloud, all, [this](const CloudFragment& fragment) {
    if (auto cloud = cloud_fragments_.add(fragment)) clouds_.push_back(std::move(*cloud));
  });
  subscribe<terrain_t>(bus, channels::kTerrain, all, [this, vehicle](const TerrainFragment& tile) {
    const auto terrain = terrain_tiles_.add(tile);
    if (!terrain) return;
    const int scan = static_cast<int>(clouds_.size());
    add(hazards_of(*terrain, scan, T_odom_body().z_m, vehicle));
  });
  subscribe<planned_path_t>(bus, channels::kPath, all, [this, vehicle](const PlannedPath& path) {
    add(hazards_of(path, T_odom_body().z_m, vehicle));
  });
  subscribe<gas_t>(bus, channels::kGas, all, [this](const GasReading& reading) {
    if (pose_) add(hazards_of(reading, T_odom_body()));
  });
  subscribe<sinkage_t>(bus, channels::kSinkage, all, [this](const SinkageReading& reading) {
    if (pose_) add(hazards_of(reading, T_odom_body()));
  });
}

void ScanHazardRecord::add(std::vector<Hazard> hazards) {
  hazards_.insert(hazards_.end(), std::make_move_iterator(hazards.begin()),
                  std::make_move_iterator(hazards.end()));
}

LevelPose ScanHazardRecord::T_odom_body() const {
  return pose_ ? LevelPose{pose_->T_odom_body, pose_->z_m} : LevelPose{};
}

}  // namespace adit
