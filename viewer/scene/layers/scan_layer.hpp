// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/bus/bus.hpp"
#include "common/sensing/laser_tilt.hpp"
#include "common/types/cloud.hpp"
#include "common/types/planned_path.hpp"
#include "viewer/scene/map_frame.hpp"
#include "viewer/server/topic_board.hpp"

namespace adit {

/// The 3D scans with the plans made on each, /scans, from SCAN_REQUEST, CLOUD and PATH.
class ScanLayer {
 public:
  /// All must outlive this.
  ScanLayer(Bus& bus, TopicBoard& board, const MapFrame& frame);
  ScanLayer(const ScanLayer&) = delete;
  ScanLayer& operator=(const ScanLayer&) = delete;

  /// Returns the number of the scan: 1, 2, ... in order of time.
  int add_cloud(const Cloud& cloud);

 private:
  /// What is shown of a PlannedPath.
  struct Plan {
    PlanOutcome outcome = PlanOutcome::kFound;
    std::string reason;
    double reached_m = 0.0;
    double length_m = 0.0;
    double clearance_m = 0.0;  ///< infinite without a path
  };
  struct Scan {
    int number = 0;
    std::int32_t id = 0;
    std::int64_t utime = 0;
    std::optional<LaserId> laser;
    std::size_t points = 0;
    bool complete = true;
    AnchoredPose T_level;
    std::vector<Plan> plans;
  };

  void on_path(const PlannedPath& path);
  void append(const Scan& scan);

  TopicBoard& board_;
  const MapFrame& frame_;
  TopicId topic_ = 0;
  std::optional<ScanRequest> request_;
  std::optional<Scan> newest_;
  int scans_ = 0;
};

}  // namespace adit
