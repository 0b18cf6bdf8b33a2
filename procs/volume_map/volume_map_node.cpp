// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/volume_map/volume_map_node.hpp"

#include <algorithm>
#include <exception>

#include "common/bus/channels.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/mapping/cloud.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/mapping/pose_graph.hpp"
#include "common/messages/mapping/volume.hpp"

namespace adit {
namespace {

// Several scans, and a graph of some thousand local maps. Beyond that the oldest clouds are
// dropped; no stage waits for them.
constexpr std::size_t kFragmentsWaiting = 200;
// Limits the rate of publishing after a restart, when all volumes are published again.
constexpr int kVolumesPerTick = 4;
constexpr std::int64_t kPeriodUs = 500'000;
constexpr std::int64_t kRequestPeriodUs = 2'000'000;
constexpr std::size_t kReportedScansMax = 32;  // more than scan assembly stores

Volume volume_of(const PlacedVolume& placed, std::size_t id, std::int64_t graph_revision) {
  const SubVolume& volume = placed.volume;
  return {volume.utime(),
          static_cast<std::int32_t>(id),
          volume.scans(),
          graph_revision,
          placed.anchor->local_map,
          placed.T_map_volume.plan,
          volume.cell_m(),
          volume.occupied(),
          volume.free(),
          volume.octree(),
          placed.T_map_volume.z_m};
}

}  // namespace

VolumeMapNode::VolumeMapNode(Bus& bus, const Params& params) : bus_(bus), map_(params) {
  if (!params.journal.empty()) {
    map_.restore(journal_.emplace(params.journal).take_restored());
    map_.release_points();
  }
  subscribe<cloud_t>(bus, channels::kCloud, Delivery::queued(kFragmentsWaiting),
                     [this](const CloudFragment& fragment) {
                       if (const auto cloud = clouds_.add(fragment)) on_cloud(*cloud);
                     });
  subscribe<cloud_t>(bus, channels::kCloudResend, Delivery::queued(kFragmentsWaiting),
                     [this](const CloudFragment& fragment) {
                       if (const auto cloud = resent_clouds_.add(fragment)) on_cloud(*cloud);
                     });
  subscribe<pose_graph_t>(bus, channels::kPoseGraph, Delivery::queued(kFragmentsWaiting),
                          [this](const PoseGraphFragment& fragment) {
                            const auto graph = graphs_.add(fragment);
                            if (!graph) return;
                            map_.set_graph(*graph);
                            publish_changes();
                          });
  subscribe<map_correction_t>(bus, channels::kMapCorrection, Delivery::latest(),
                              [this](const MapCorrection& correction) {
                                map_.set_correction(correction);
                                store();
                                publish_changes();
                              });
  subscribe<scan_match_t>(
      bus, channels::kScanMatch, Delivery::latest(),
      [this](const ScanMatch& match) { map_.set_odom_epoch(match.odom_epoch_utime); });
  bus.create_timer(kPeriodUs, [this](std::int64_t utime) {
    request_map(utime);
    publish_changes();
  });
  bus.create_timer(kRequestPeriodUs, [this](std::int64_t utime) { request_missed_clouds(utime); });
}

void VolumeMapNode::request_map(std::int64_t utime) {
  if (!map_requester_.is_due(utime, map_.graph_revision() == 0)) return;
  publish(bus_, channels::kMapRequest, to_message(MapRequest{utime, "volume_map"}));
  map_requester_.received(utime);
}

void VolumeMapNode::request_missed_clouds(std::int64_t utime) {
  if (!map_.has_odom_epoch()) return;
  const auto& scan_times = map_.scan_utimes();
  const auto reported = static_cast<std::ptrdiff_t>(std::min(scan_times.size(), kReportedScansMax));
  publish(bus_, channels::kCloudRequest,
          to_message(CloudRequest{utime,
                                  std::max<std::int64_t>(map_.localized_from_utime() - 1, 0),
                                  {scan_times.end() - reported, scan_times.end()}}));
}

void VolumeMapNode::on_cloud(const Cloud& cloud) {
  if (map_.has(cloud.utime)) return;
  superseded_ = clouds_.counts().superseded;
  incomplete_ = !cloud.complete;
  placed_ = map_.add(cloud);
  store();
  publish_changes();
}

/// Stores before publishing, so that no published volume is lost. The points are no longer needed
/// here.
void VolumeMapNode::store() {
  if (!journal_) return;
  journal_failure_.clear();
  try {
    journal_->store(map_);
    map_.release_points();
  } catch (const std::exception& failure) {
    journal_failure_ = failure.what();
  }
}

void VolumeMapNode::publish_changes() {
  published_.resize(map_.volumes().size());
  int left = kVolumesPerTick;
  for (std::size_t id = 0; id < published_.size(); ++id) {
    const PlacedVolume& placed = map_.volumes()[id];
    const bool new_cells = published_[id].revision != placed.volume.scans();
    const bool moved = published_[id].T_map_volume != placed.T_map_volume;
    if (!placed.anchor || (!new_cells && !moved)) continue;
    if (new_cells && left-- <= 0) continue;
    const Volume volume = volume_of(placed, id, map_.graph_revision());
    if (new_cells) {
      for (const VolumeFragment& fragment : split(volume)) {
        publish(bus_, channels::kVolume, to_message(fragment));
      }
    } else {
      publish(bus_, channels::kVolume, to_message(pose_only(volume)));
    }
    published_[id] = {placed.volume.scans(), placed.T_map_volume};
  }
}

Health VolumeMapNode::health() const {
  using Level = Health::Level;
  if (clouds_.counts().superseded > superseded_) {
    return {Level::kDegraded, "fragments of a 3D scan are missing"};
  }
  const std::string not_stored = storage_failure(journal_, journal_failure_);
  if (!not_stored.empty()) return {Level::kFault, not_stored};
  if (!placed_) return {Level::kDegraded, "the last 3D scan cannot be localized"};
  if (incomplete_) return {Level::kDegraded, "the last 3D scan is incomplete"};
  if (journal_ && !journal_->damage().empty()) return {Level::kDegraded, journal_->damage()};
  return {};
}

}  // namespace adit
