// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/terrain/terrain_node.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/bus/channels.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/mapping/cloud.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/mapping/pose_graph.hpp"
#include "common/messages/mapping/terrain.hpp"
#include "common/pose_graph/map_correction.hpp"

namespace adit {
namespace {

constexpr std::size_t kFragmentsWaiting = 200;  // several sweeps
constexpr std::int64_t kRequestPeriodUs = 2'000'000;

}  // namespace

TerrainNode::TerrainNode(Bus& bus, const Params& params)
    : bus_(bus), terrain_(params), memory_(params) {
  subscribe<pose_t>(bus, channels::kPose, Delivery::latest(),
                    [this](const StampedPose& pose) { memory_.add(pose.utime, pose.T_odom_body); });
  subscribe<cloud_t>(bus, channels::kCloud, Delivery::queued(kFragmentsWaiting),
                     [this](const CloudFragment& fragment) {
                       if (const auto cloud = assembler_.add(fragment)) on_cloud(*cloud);
                     });
  subscribe<cloud_t>(bus, channels::kCloudResend, Delivery::queued(kFragmentsWaiting),
                     [this](const CloudFragment& fragment) { on_resent(fragment); });
  subscribe<scan_match_t>(bus, channels::kScanMatch, Delivery::latest(),
                          [this](const ScanMatch& match) { on_match(match); });
  subscribe<map_correction_t>(
      bus, channels::kMapCorrection, Delivery::latest(),
      [this](const MapCorrection& correction) { on_correction(correction); });
  bus.create_timer(kRequestPeriodUs, [this](std::int64_t utime) { request_and_report(utime); });
}

/// Repeats, as any message may be lost. Clouds of a previous odom frame are not requested.
void TerrainNode::request_and_report(std::int64_t utime) {
  const std::int64_t previous_odom_utime = std::max<std::int64_t>(odom_epoch_utime_ - 1, 0);
  const std::int64_t newest_utime = ready_ ? ready_->utime : 0;
  const CloudRequest request{utime, std::max(newest_utime, previous_odom_utime), {}};
  publish(bus_, channels::kCloudRequest, to_message(request));
  if (ready_) publish(bus_, channels::kTerrainReady, to_message(*ready_));
}

/// Fragments of a cloud that is missing here; those of older clouds were requested by other stages.
void TerrainNode::on_resent(const CloudFragment& fragment) {
  if (ready_ && fragment.part.utime <= ready_->utime) return;
  if (const auto cloud = assembler_.add(fragment)) on_cloud(*cloud);
}

void TerrainNode::on_match(const ScanMatch& match) {
  if (match.odom_epoch_utime == odom_epoch_utime_) return;
  if (odom_epoch_utime_ != 0) {
    T_map_previous_odom_ = std::exchange(T_map_odom_, std::nullopt);
    memory_.reset(match.odom_epoch_utime);
  }
  odom_epoch_utime_ = match.odom_epoch_utime;
}

/// Relates the odom frames through map.
void TerrainNode::on_correction(const MapCorrection& correction) {
  if (correction.utime < odom_epoch_utime_) return;  // of the previous odom frame
  if (T_map_odom_)
    memory_.correct(between(correction.T_map_odom, *T_map_odom_),
                    std::pow(position_sd_m(correction.body_covariance), 2));
  T_map_odom_ = correction.T_map_odom;
  if (!T_map_previous_odom_ || !odom_is_localized(correction)) return;
  memory_.anchor(between(correction.T_map_odom, *T_map_previous_odom_));
  T_map_previous_odom_.reset();
}

void TerrainNode::on_cloud(const Cloud& cloud) {
  if (cloud.utime < odom_epoch_utime_)
    return;  // of the previous odom frame, in which no stage plans
  superseded_ = assembler_.counts().superseded;
  for (const TerrainFragment& fragment : split(terrain_.make(cloud, memory_))) {
    publish(bus_, channels::kTerrain, to_message(fragment));
  }
  ready_ = {cloud.utime, cloud.id, cloud.complete};
  publish(bus_, channels::kTerrainReady, to_message(*ready_));
}

Health TerrainNode::health() const {
  using Level = Health::Level;
  if (assembler_.counts().superseded > superseded_) {
    return {Level::kDegraded, "fragments of a 3D scan are missing"};
  }
  if (ready_ && !ready_->complete) return {Level::kDegraded, "the last 3D scan is incomplete"};
  return {};
}

}  // namespace adit
