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
  std::string journal;  ///< file that keeps what was seen; empty: nothing is kept

  template <class V>
  void visit(V& v) {
    v("journal", journal);
    VolumeMapParams::visit(v);
  }
};

/// In:  CLOUD and CLOUD_RESEND (cloud_t) and POSE_GRAPH (pose_graph_t), all in pieces;
///      MAP_CORRECTION (map_correction_t); SCAN_MATCH (scan_match_t), for when odom began.
/// Out: VOLUME (volume_t), in pieces: each sub-volume that is tied to the pose graph, as soon as it
///      is and whenever a cloud came into it; and its pose alone whenever that changed.
///      MAP_REQUEST (map_request_t), until there is a graph. CLOUD_REQUEST (cloud_request_t),
///      each 2 s, so that no 3D scan is missed while this was not there; none of an odom of which
///      nobody knows where it was.
/// Where a journal is named and there, the volume in it is continued. Points are in the journal
/// alone.
class VolumeMapNode {
 public:
  using Params = VolumeMapNodeParams;

  /// Throws std::runtime_error where the journal cannot be used.
  VolumeMapNode(Bus& bus, const Params& params);

  /// Degraded where the newest cloud was cut short, lacks pieces or could not be placed, and where
  /// it cannot be kept.
  [[nodiscard]] Health health() const;

  [[nodiscard]] const VolumeMap& map() const { return map_; }

 private:
  struct Published {
    int revision = 0;  ///< none yet
    Pose2 T_map_volume;
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
  CloudReassembler resent_clouds_;  ///< an older one, while the newest comes in pieces as well
  PoseGraphReassembler graphs_;
  std::vector<Published> published_;  ///< by the id of the sub-volume
  std::int64_t superseded_ = 0;       ///< clouds that lacked pieces, when the last one was complete
  bool incomplete_ = false;
  bool placed_ = true;
};

}  // namespace adit
