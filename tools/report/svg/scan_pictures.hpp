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

/// A 3D scan and what was made of it, as far as there is of it in a log.
struct ScanProducts {
  std::optional<Cloud> cloud;
  std::optional<TerrainMap> terrain;
  std::optional<PlanGoal> goal;
  std::optional<PlannedPath> path;
};

/// Small pictures of a scan, each ready to stand in a page; empty where there is nothing to show.
struct ScanPictures {
  std::string view;          ///< of the points, an <img>
  std::string terrain;       ///< an <svg>, with the path or the blocking cells
  std::string c_space;       ///< likewise, at the heading of the way
  double heading_deg = 0.0;  ///< of that, ahead being 0
};

/// Draws scans for the page of a mission.
class ScanRenderer {
 public:
  explicit ScanRenderer(const PlanningParams& params) : params_(params), planning_(params) {}

  [[nodiscard]] ScanPictures render(const ScanProducts& scan);

 private:
  PlanningParams params_;
  Planning planning_;
};

}  // namespace adit
