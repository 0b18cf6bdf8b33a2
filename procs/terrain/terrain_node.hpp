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

/// In:  CLOUD and CLOUD_RESEND (cloud_t), in fragments; POSE (pose_t), for the traversed path;
///      SCAN_MATCH (scan_match_t) and MAP_CORRECTION (map_correction_t), to carry the memory over
///      to a new odom frame.
/// Out: TERRAIN (terrain_t), in fragments, for each complete cloud, and then TERRAIN_READY
///      (terrain_ready_t), repeated every 2 s. CLOUD_REQUEST (cloud_request_t), every 2 s, for the
///      newest cloud if it or a fragment of it is missing.
class TerrainNode {
 public:
  using Params = TerrainParams;

  TerrainNode(Bus& bus, const Params& params);

  /// Degraded if the newest 3D scan is incomplete or fragments of it are missing.
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
  std::optional<TerrainReady> ready_;  ///< of the newest cloud with all fragments
  std::int64_t superseded_ = 0;  ///< clouds with missing fragments up to the last complete one
  std::int64_t odom_epoch_utime_ = 0;  ///< begin of the odom frame; 0: unknown
  std::optional<Pose2> T_map_odom_;
  std::optional<Pose2> T_map_previous_odom_;  ///< of the previous odom frame, until it is anchored
};

}  // namespace adit
