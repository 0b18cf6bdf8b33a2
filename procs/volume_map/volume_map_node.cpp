// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/volume_map/volume_map_node.hpp"

#include <algorithm>
#include <exception>

#include "common/bus/channels.hpp"
#include "common/bus/typed.hpp"
#include "common/messages/cloud_request.hpp"
#include "common/messages/map_correction.hpp"
#include "common/messages/map_request.hpp"
#include "common/messages/scan_match.hpp"
#include "common/messages/volume_pieces.hpp"

namespace adit {
namespace {

// Several sweeps, and a graph of some thousand local maps. Where this is not enough, the oldest
// clouds are lost, and nobody waits.
constexpr std::size_t kPiecesWaiting = 200;
// After a restart all goes out again, not all at once.
constexpr int kVolumesAtOnce = 4;
constexpr std::int64_t kPeriodUs = 500'000;
constexpr std::int64_t kAskPeriodUs = 2'000'000;
constexpr std::size_t kHaveMax = 32;  // more than anybody holds

Volume volume_of(const PlacedVolume& placed, std::size_t id, std::int64_t graph_revision) {
  const SubVolume& volume = placed.volume;
  return {volume.utime(),        static_cast<std::int32_t>(id),
          volume.scans(),        graph_revision,
          placed.tie->local_map, placed.T_map_volume,
          volume.cell_m(),       volume.occupied(),
          volume.free(),         volume.octree()};
}

}  // namespace

VolumeMapNode::VolumeMapNode(Bus& bus, const Params& params) : bus_(bus), map_(params) {
  if (!params.journal.empty()) {
    map_.restore(journal_.emplace(params.journal).take_restored());
    map_.forget_points();
  }
  subscribe<cloud_t>(bus, channels::kCloud, Delivery::queued(kPiecesWaiting),
                     [this](const CloudPiece& piece) {
                       if (const auto cloud = clouds_.add(piece)) on_cloud(*cloud);
                     });
  subscribe<cloud_t>(bus, channels::kCloudAgain, Delivery::queued(kPiecesWaiting),
                     [this](const CloudPiece& piece) {
                       if (const auto cloud = clouds_again_.add(piece)) on_cloud(*cloud);
                     });
  subscribe<pose_graph_t>(bus, channels::kPoseGraph, Delivery::queued(kPiecesWaiting),
                          [this](const PoseGraphPiece& piece) {
                            const auto graph = graphs_.add(piece);
                            if (!graph) return;
                            map_.set_graph(*graph);
                            publish_news();
                          });
  subscribe<map_correction_t>(bus, channels::kMapCorrection, Delivery::latest(),
                              [this](const MapCorrection& correction) {
                                map_.set_correction(correction);
                                keep();
                                publish_news();
                              });
  subscribe<scan_match_t>(
      bus, channels::kScanMatch, Delivery::latest(),
      [this](const ScanMatch& match) { map_.set_odom_begin(match.odom_utime); });
  bus.every(kPeriodUs, [this](std::int64_t utime) {
    ask(utime);
    publish_news();
  });
  bus.every(kAskPeriodUs, [this](std::int64_t utime) { ask_for_missed(utime); });
}

void VolumeMapNode::ask(std::int64_t utime) {
  if (!asker_.is_due(utime, map_.graph_revision() == 0)) return;
  publish(bus_, channels::kMapRequest, to_message(MapRequest{utime, "volume_map"}));
  asker_.heard(utime);
}

void VolumeMapNode::ask_for_missed(std::int64_t utime) {
  if (!map_.knows_odom_begin()) return;
  const auto& taken = map_.taken_utime();
  const auto few = static_cast<std::ptrdiff_t>(std::min(taken.size(), kHaveMax));
  publish(bus_, channels::kCloudRequest,
          to_message(CloudRequest{utime,
                                  "volume_map",
                                  std::max<std::int64_t>(map_.known_from_utime() - 1, 0),
                                  {taken.end() - few, taken.end()}}));
}

void VolumeMapNode::on_cloud(const Cloud& cloud) {
  if (map_.has(cloud.utime)) return;
  superseded_ = clouds_.counts().superseded;
  cut_short_ = !cloud.complete;
  placed_ = map_.add(cloud);
  keep();
  publish_news();
}

/// To the disk first: what was announced is not forgotten. The points are of no more use here.
void VolumeMapNode::keep() {
  if (!journal_) return;
  journal_failure_.clear();
  try {
    journal_->keep(map_);
    map_.forget_points();
  } catch (const std::exception& failure) {
    journal_failure_ = failure.what();
  }
}

void VolumeMapNode::publish_news() {
  published_.resize(map_.volumes().size());
  int left = kVolumesAtOnce;
  for (std::size_t id = 0; id < published_.size(); ++id) {
    const PlacedVolume& placed = map_.volumes()[id];
    const bool new_cells = published_[id].revision != placed.volume.scans();
    const bool moved = published_[id].T_map_volume != placed.T_map_volume;
    if (!placed.tie || (!new_cells && !moved)) continue;
    if (new_cells && left-- <= 0) continue;
    const Volume volume = volume_of(placed, id, map_.graph_revision());
    if (new_cells) {
      for (const VolumePiece& piece : divide(volume)) {
        publish(bus_, channels::kVolume, to_message(piece));
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
    return {Level::kDegraded, "a 3D scan came without some of its pieces"};
  }
  if (!journal_failure_.empty()) return {Level::kDegraded, journal_failure_};
  if (!placed_) return {Level::kDegraded, "nobody knows where the last 3D scan was taken"};
  if (cut_short_) return {Level::kDegraded, "the last 3D scan was cut short"};
  return {};
}

}  // namespace adit
