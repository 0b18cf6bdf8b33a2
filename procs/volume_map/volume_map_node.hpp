// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/bus/bus.hpp"
#include "common/messages/diagnostics.hpp"
#include "common/messages/mapping/cloud.hpp"
#include "common/messages/mapping/pose_graph.hpp"
#include "common/types/map_request.hpp"
#include "procs/volume_map/volume_journal.hpp"
#include "procs/volume_map/volume_map.hpp"

namespace adit {

struct VolumeMapNodeParams : VolumeMapParams {
  std::string journal;  ///< file that stores the volume; empty: no journal

  template <class V>
  void visit(V& v) {
    v("journal", journal);
    VolumeMapParams::visit(v);
  }
};

/// In:  CLOUD and CLOUD_RESEND (cloud_t) and POSE_GRAPH (pose_graph_t), all in fragments;
///      MAP_CORRECTION (map_correction_t); SCAN_MATCH (scan_match_t), for the begin of odom.
/// Out: VOLUME (volume_t), in fragments: each sub-volume that is anchored to the pose graph, once
///      anchored and after each cloud in it; only its pose when that changes.
///      MAP_REQUEST (map_request_t), until there is a graph. CLOUD_REQUEST (cloud_request_t),
///      every 2 s, for 3D scans missed while the stage was down; none of an odom frame whose pose
///      in map cannot be determined.
/// With a journal the stored volume is continued. Points are stored in the journal only.
class VolumeMapNode {
 public:
  using Params = VolumeMapNodeParams;

  /// Throws std::runtime_error if the journal cannot be used.
  VolumeMapNode(Bus& bus, const Params& params);

  /// Fault if the journal cannot be written; degraded if the newest 3D scan is incomplete, lacks
  /// fragments or cannot be localized.
  [[nodiscard]] Health health() const;

  [[nodiscard]] const VolumeMap& map() const { return map_; }

 private:
  struct Published {
    int revision = 0;  ///< 0: none yet
    LevelPose T_map_volume;
  };

  void on_cloud(const Cloud& cloud);
  void request_map(std::int64_t utime);
  void request_missed_clouds(std::int64_t utime);
  void store();
  void publish_changes();

  Bus& bus_;
  VolumeMap map_;
  std::optional<VolumeJournal> journal_;
  std::string journal_failure_;
  MapRequestTimer map_requester_;
  CloudReassembler clouds_;
  CloudReassembler resent_clouds_;  ///< older clouds, while the newest one arrives too
  PoseGraphReassembler graphs_;
  std::vector<Published> published_;  ///< by id of the sub-volume
  std::int64_t superseded_ = 0;       ///< clouds with missing fragments up to the last complete one
  bool incomplete_ = false;
  bool placed_ = true;
};

}  // namespace adit
