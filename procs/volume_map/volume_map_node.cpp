// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/volume_map/volume_map_node.hpp"

#include "common/bus/channels.hpp"
#include "common/bus/typed.hpp"
#include "common/messages/map_correction.hpp"
#include "common/messages/volume_pieces.hpp"

namespace adit {
namespace {

// Several sweeps, and a graph of some thousand local maps. Where this is not enough, the oldest
// clouds are lost, and nobody waits.
constexpr std::size_t kPiecesWaiting = 200;

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
  subscribe<cloud_t>(bus, channels::kCloud, Delivery::queued(kPiecesWaiting),
                     [this](const CloudPiece& piece) {
                       if (const auto cloud = clouds_.add(piece)) on_cloud(*cloud);
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
                                publish_news();
                              });
}

void VolumeMapNode::on_cloud(const Cloud& cloud) {
  superseded_ = clouds_.counts().superseded;
  cut_short_ = !cloud.complete;
  map_.add(cloud);
  publish_news();
}

void VolumeMapNode::publish_news() {
  published_.resize(map_.volumes().size());
  for (std::size_t id = 0; id < published_.size(); ++id) {
    const PlacedVolume& placed = map_.volumes()[id];
    const bool new_cells = published_[id].revision != placed.volume.scans();
    const bool moved = published_[id].T_map_volume != placed.T_map_volume;
    if (!placed.tie || (!new_cells && !moved)) continue;
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
  if (cut_short_) return {Level::kDegraded, "the last 3D scan was cut short"};
  return {};
}

}  // namespace adit
