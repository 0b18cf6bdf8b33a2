// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "common/bus/bus.hpp"
#include "common/messages/diagnostics.hpp"
#include "common/messages/mapping/cloud.hpp"
#include "common/pose_graph/map_correction.hpp"
#include "common/sensing/scan_match.hpp"
#include "common/types/terrain_map.hpp"
#include "procs/terrain/terrain.hpp"

namespace adit {

/// In:  CLOUD and CLOUD_RESEND (cloud_t), in pieces; POSE (pose_t), for the way that the body has
///      come; SCAN_MATCH (scan_match_t) and MAP_CORRECTION (map_correction_t), to remember over a
///      new odom.
/// Out: TERRAIN (terrain_t), in pieces, for each cloud of which all pieces came, and then
///      TERRAIN_READY (terrain_ready_t), again each 2 s. CLOUD_REQUEST (cloud_request_t), each 2 s,
///      for the newest cloud if it did not come, or not all of it.
class TerrainNode {
 public:
  using Params = TerrainParams;

  TerrainNode(Bus& bus, const Params& params);

  /// Degraded where the newest cloud was cut short, or lacks pieces.
  [[nodiscard]] Health health() const;

 private:
  void on_resent(const CloudFragment& fragment);
  void on_cloud(const Cloud& cloud);
  void request_and_report(std::int64_t utime);
  void on_match(const ScanMatch& match);
  void on_correction(const MapCorrection& correction);

  Bus& bus_;
  Terrain terrain_;
  TerrainMemory memory_;
  CloudReassembler assembler_;
  std::optional<TerrainReady> ready_;  ///< of the newest cloud of which all pieces came
  std::int64_t superseded_ = 0;  ///< clouds that lacked pieces, when the last one was complete
  std::int64_t odom_epoch_utime_ = 0;  ///< when odom began
  std::optional<Pose2> T_map_odom_;
  std::optional<Pose2> T_map_previous_odom_;  ///< of the odom of before, until they are tied
};

}  // namespace adit
