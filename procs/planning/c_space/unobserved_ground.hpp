// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "common/geometry/convex_polygon.hpp"
#include "common/types/terrain_map.hpp"
#include "common/types/vehicle.hpp"
#include "procs/planning/c_space/ground_layers.hpp"

namespace adit {

/// The ground around the robot that its lasers cannot scan: beside the body, and ahead of and
/// behind it up to where the steepest beams reach the ground. This ground is assumed to be like the
/// ground under the robot; ahead and behind only if the observed ground beyond the zone continues
/// at the same height.
class BlindZone {
 public:
  BlindZone(const TerrainMap& terrain, const Pose2& T_level_body, const Vehicle& vehicle,
            const GroundLimits& limits);

  [[nodiscard]] bool contains(const Eigen::Vector2d& p_level) const;

 private:
  Pose2 T_body_level_;
  std::vector<ConvexPolygon> parts_;
};

/// The terrain map with the unconfirmed drops set to Ground::kNeverObserved. Beams that pass over
/// a cell without a return show only that its ground is lower than they are: this holds in a pit,
/// but also behind a rail, behind the crest of a slope and where even ground returns nothing. A
/// connected depression is a confirmed drop if the beams over some of its cells are lower than
/// passable ground can be there: than ground that falls from the observed rim with a slope of
/// `grade_max` [m/m] and by a step of `step_max_m`, which a wheel climbs.
TerrainMap with_confirmed_drops(TerrainMap terrain, double step_max_m, double grade_max);

}  // namespace adit
