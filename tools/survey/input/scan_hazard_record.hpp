// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "common/bus/bus.hpp"
#include "common/messages/mapping/cloud.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/mapping/terrain.hpp"
#include "common/records/hazard.hpp"
#include "common/types/vehicle.hpp"
#include "tools/survey/input/cloud_store.hpp"

namespace adit {

/// Collects the 3D scans (CLOUD), without beams that have no return, and what PATH, TERRAIN, GAS
/// and SINKAGE tell of hazards.
class ScanHazardRecord {
 public:
  /// `bus` must outlive this. `vehicle`: decides which roof is low. `scratch`: folder for a
  /// temporary file.
  ScanHazardRecord(Bus& bus, const Vehicle& vehicle, const std::filesystem::path& scratch);
  ScanHazardRecord(const ScanHazardRecord&) = delete;
  ScanHazardRecord& operator=(const ScanHazardRecord&) = delete;

  [[nodiscard]] CloudStore release_clouds() { return std::move(clouds_); }
  [[nodiscard]] std::vector<Hazard> release_hazards() { return std::move(hazards_); }

 private:
  void add(std::vector<Hazard> hazards);
  [[nodiscard]] LevelPose T_odom_body() const;

  CloudReassembler cloud_fragments_;
  TerrainReassembler terrain_tiles_;
  std::optional<StampedPose> pose_;
  CloudStore clouds_;
  std::vector<Hazard> hazards_;
};

}  // namespace adit
