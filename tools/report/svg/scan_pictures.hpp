// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/picture/legend.hpp"
#include "common/types/cloud.hpp"
#include "common/types/planned_path.hpp"
#include "common/types/terrain_map.hpp"
#include "procs/planning/planning.hpp"

namespace adit {

/// A 3D scan and its products, as far as the log has them.
struct ScanProducts {
  std::optional<Cloud> cloud;
  std::optional<TerrainMap> terrain;
  std::optional<PlanGoal> goal;
  std::optional<PlannedPath> path;
};

/// Small pictures of a scan as data URIs; empty without data.
struct ScanPictures {
  std::string view;          ///< the points (PNG)
  std::string terrain;       ///< with the path or the blocking cells (SVG)
  std::string c_space;       ///< at `heading_deg` (SVG)
  double heading_deg = 0.0;  ///< heading of the path or the goal in the frame of the level
};

/// Renders scans for the page of a mission. The C-space is computed with the recorded parameters of
/// the planner.
class ScanRenderer {
 public:
  explicit ScanRenderer(const PlanningParams& params) : params_(params), planning_(params) {}

  [[nodiscard]] ScanPictures render(const ScanProducts& scan);

 private:
  PlanningParams params_;
  Planning planning_;
};

}  // namespace adit
