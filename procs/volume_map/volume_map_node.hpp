// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "common/bus/bus.hpp"
#include "common/messages/cloud_pieces.hpp"
#include "common/messages/heartbeat.hpp"
#include "common/messages/pose_graph_pieces.hpp"
#include "procs/volume_map/volume_map.hpp"

namespace adit {

/// In:  CLOUD (cloud_t) and POSE_GRAPH (pose_graph_t), both in pieces; MAP_CORRECTION
///      (map_correction_t).
/// Out: VOLUME (volume_t), in pieces: each sub-volume that is tied to the pose graph, as soon as it
///      is and whenever a cloud came into it; and its pose alone whenever that changed.
class VolumeMapNode {
 public:
  using Params = VolumeMapParams;

  VolumeMapNode(Bus& bus, const Params& params);

  /// Degraded where the newest cloud was cut short, or lacks pieces.
  [[nodiscard]] Health health() const;

  [[nodiscard]] const VolumeMap& map() const { return map_; }

 private:
  struct Published {
    int revision = 0;  ///< none yet
    Pose2 T_map_volume;
  };

  void on_cloud(const Cloud& cloud);
  void publish_news();

  Bus& bus_;
  VolumeMap map_;
  CloudAssembler clouds_;
  PoseGraphAssembler graphs_;
  std::vector<Published> published_;  ///< by the id of the sub-volume
  std::int64_t superseded_ = 0;       ///< clouds that lacked pieces, when the last one was complete
  bool cut_short_ = false;
};

}  // namespace adit
