// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/terrain/terrain_node.hpp"

#include <algorithm>
#include <utility>

#include "common/bus/channels.hpp"
#include "common/bus/typed.hpp"
#include "common/messages/cloud_request.hpp"
#include "common/messages/map_correction.hpp"
#include "common/messages/pose.hpp"
#include "common/messages/scan_match.hpp"
#include "common/messages/terrain_made.hpp"
#include "common/messages/terrain_tiles.hpp"
#include "common/pose_graph/position_sd.hpp"

namespace adit {
namespace {

constexpr std::size_t kPiecesWaiting = 200;  // several sweeps
constexpr std::int64_t kAskPeriodUs = 2'000'000;

}  // namespace

TerrainNode::TerrainNode(Bus& bus, const Params& params)
    : bus_(bus), terrain_(params), memory_(params) {
  subscribe<pose_t>(bus, channels::kPose, Delivery::latest(),
                    [this](const StampedPose& pose) { memory_.add(pose.utime, pose.T_odom_body); });
  subscribe<cloud_t>(bus, channels::kCloud, Delivery::queued(kPiecesWaiting),
                     [this](const CloudPiece& piece) {
                       if (const auto cloud = assembler_.add(piece)) on_cloud(*cloud);
                     });
  subscribe<cloud_t>(bus, channels::kCloudAgain, Delivery::queued(kPiecesWaiting),
                     [this](const CloudPiece& piece) { on_repeated(piece); });
  subscribe<scan_match_t>(bus, channels::kScanMatch, Delivery::latest(),
                          [this](const ScanMatch& match) { on_match(match); });
  subscribe<map_correction_t>(
      bus, channels::kMapCorrection, Delivery::latest(),
      [this](const MapCorrection& correction) { on_correction(correction); });
  bus.every(kAskPeriodUs, [this](std::int64_t utime) { ask_and_tell(utime); });
}

/// Any message may be lost. Of an odom of before nothing is asked for.
void TerrainNode::ask_and_tell(std::int64_t utime) {
  const std::int64_t of_before_utime = std::max<std::int64_t>(odom_utime_ - 1, 0);
  const std::int64_t newest_utime = made_ ? made_->utime : 0;
  const CloudRequest request{utime, "terrain", std::max(newest_utime, of_before_utime), {}};
  publish(bus_, channels::kCloudRequest, to_message(request));
  if (made_) publish(bus_, channels::kTerrainMade, to_message(*made_));
}

/// Pieces that are missing; those of an older one are for others.
void TerrainNode::on_repeated(const CloudPiece& piece) {
  if (made_ && piece.part.utime <= made_->utime) return;
  if (const auto cloud = assembler_.add(piece)) on_cloud(*cloud);
}

void TerrainNode::on_match(const ScanMatch& match) {
  if (match.odom_utime == odom_utime_) return;
  if (odom_utime_ != 0) {
    T_map_before_ = std::exchange(T_map_odom_, std::nullopt);
    memory_.begin_anew(match.odom_utime);
  }
  odom_utime_ = match.odom_utime;
}

/// The same place of the map in both: that is how the one odom lies in the other.
void TerrainNode::on_correction(const MapCorrection& correction) {
  if (correction.utime < odom_utime_) return;  // of the odom of before
  T_map_odom_ = correction.T_map_odom;
  if (!T_map_before_ || !says_where_odom_is(correction)) return;
  memory_.tie(between(correction.T_map_odom, *T_map_before_));
  T_map_before_.reset();
}

void TerrainNode::on_cloud(const Cloud& cloud) {
  if (cloud.utime < odom_utime_) return;  // nobody plans in the odom of before
  superseded_ = assembler_.counts().superseded;
  for (const TerrainTile& tile : divide(terrain_.make(cloud, memory_))) {
    publish(bus_, channels::kTerrain, to_message(tile));
  }
  made_ = {cloud.utime, cloud.id, cloud.complete};
  publish(bus_, channels::kTerrainMade, to_message(*made_));
}

Health TerrainNode::health() const {
  using Level = Health::Level;
  if (assembler_.counts().superseded > superseded_) {
    return {Level::kDegraded, "a 3D scan came without some of its pieces"};
  }
  if (made_ && !made_->complete) return {Level::kDegraded, "the last 3D scan was cut short"};
  return {};
}

}  // namespace adit
