// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/bus/bus.hpp"
#include "common/messages/mapping/cloud.hpp"
#include "common/messages/mapping/terrain.hpp"
#include "common/sensing/laser_scan.hpp"
#include "common/types/cloud.hpp"
#include "common/types/planned_path.hpp"
#include "tools/report/svg/scan_pictures.hpp"

namespace adit {

/// The answer of the planner to one goal.
struct RecordedPlan {
  std::int64_t utime = 0;  ///< of the goal if it is in the log, otherwise of the terrain
  PlanOutcome outcome = PlanOutcome::kFound;
  std::string reason;
  double reached_m = 0.0;
  double length_m = 0.0;
  double least_clearance_m = 0.0;  ///< infinite without a path
  std::size_t blocking = 0;        ///< number of blocking cells
};

/// A 3D scan of a mission with its plans and pictures.
struct RecordedScan {
  int number = 0;  ///< in order of the log, from 1
  std::int32_t id = 0;
  std::int64_t utime = 0;  ///< end of the sweep
  std::optional<LaserId> laser;
  std::size_t points = 0;
  bool complete = true;
  Pose2 T_odom_level;
  std::vector<RecordedPlan> plans;
  ScanPictures pictures;
};

/// Collects 3D scans from SCAN_REQUEST, CLOUD, TERRAIN, GOAL and PATH. The pictures of a scan are
/// rendered when the next scan arrives, so that only one cloud and one terrain are in memory.
class ScanRecord {
 public:
  using Render = std::function<ScanPictures(const ScanProducts&)>;

  /// `bus` must outlive this.
  ScanRecord(Bus& bus, Render render);

  /// Must be called at the end of the log. Renders the last scan.
  void finish() { finish_scan(); }

  [[nodiscard]] const std::vector<RecordedScan>& scans() const { return scans_; }

 private:
  void on_cloud(Cloud cloud);
  void on_terrain(TerrainMap terrain);
  void on_path(const PlannedPath& path);
  void finish_scan();

  Render render_;
  CloudReassembler cloud_fragments_;
  TerrainReassembler terrain_tiles_;
  std::vector<RecordedScan> scans_;
  std::optional<LaserId> laser_;  ///< of the last request
  std::int32_t request_id_ = 0;
  std::optional<PlanGoal> goal_;  ///< the last one
  ScanProducts current_;          ///< of the last scan
};

}  // namespace adit
