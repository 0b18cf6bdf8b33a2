// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "common/terrain/terrain_map.hpp"
#include "common/vehicle/vehicle.hpp"
#include "procs/planning/footprint.hpp"
#include "procs/planning/ground_limits.hpp"

namespace adit {

/// The ground around a robot that its own lasers cannot look at: beside it, and before an end of it
/// up to where the steepest beams meet the ground. It is taken to be like the ground under the
/// robot, before an end only where that goes on beyond: seen, and without a step in between.
class BlindGround {
 public:
  BlindGround(const TerrainMap& terrain, const Pose2& T_level_body, const Vehicle& vehicle,
              const GroundLimits& limits);

  [[nodiscard]] bool contains(const Eigen::Vector2d& p_level) const;

 private:
  Pose2 T_body_level_;
  std::vector<BodyRectangle> rectangles_;
};

}  // namespace adit
