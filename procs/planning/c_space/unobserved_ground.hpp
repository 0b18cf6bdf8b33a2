// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "common/types/terrain_map.hpp"
#include "common/types/vehicle.hpp"
#include "procs/planning/c_space/footprint.hpp"
#include "procs/planning/c_space/ground_layers.hpp"

namespace adit {

/// The ground around a robot that its own lasers cannot look at: beside it, and before an end of it
/// up to where the steepest beams meet the ground. It is taken to be like the ground under the
/// robot, before an end only where that goes on beyond: seen, and without a step in between.
class BlindZone {
 public:
  BlindZone(const TerrainMap& terrain, const Pose2& T_level_body, const Vehicle& vehicle,
            const GroundLimits& limits);

  [[nodiscard]] bool contains(const Eigen::Vector2d& p_level) const;

 private:
  Pose2 T_body_level_;
  std::vector<BodyRectangle> rectangles_;
};

/// The terrain without the drops that nobody saw to be any. Beams that pass over a place without
/// meeting it say that its ground is lower than they are. That is so of a pit, but behind a rail,
/// too, and where even ground gave nothing back. A hollow is a drop once beams were lower in it
/// than its rim, by the upper quartile, by more than `step_max_m`, which a wheel climbs; before, it
/// was never seen.
TerrainMap with_observed_drops(TerrainMap terrain, double step_max_m);

}  // namespace adit
