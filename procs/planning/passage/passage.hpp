// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "common/config/bounds.hpp"
#include "common/geometry/pose2.hpp"
#include "common/types/planned_path.hpp"
#include "common/types/terrain_map.hpp"
#include "common/types/vehicle.hpp"
#include "procs/planning/goals/goal_field.hpp"
#include "procs/planning/passage/wall_distance.hpp"

namespace adit {

struct PassageParams {
  double clearance_min_m = 0.025;  ///< of the outline of the body to points of obstacles
  double end_reserve_m = 0.4;      ///< that the robot could drive on beyond the end of a path
  double radius_reserve = 0.1;     ///< share by which radii exceed the turning radius

  template <class V>
  void visit(V& v) {
    v("clearance_min_m", clearance_min_m, within(0.0, 1.0));
    v("end_reserve_m", end_reserve_m, within(0.0, 5.0));
    v("radius_reserve", radius_reserve, within(0.0, 1.0));
  }
};

/// A path through a narrow passage, where cells and headings of the lattice take more of the width
/// than there is: an elastic band from the chain of cells with the most progress (Guide), with as
/// little curvature as the width allows (ElasticBand). Each pose is tested with the outline of the
/// body and the walls at the resolution of CellParts; where there is room on the other side, it
/// must keep up to 8 cm. The path ends where the body does not fit, less a reserve; it leads at
/// least as far as the goals require.
///
/// `reverse`: with the rear leading. The clearance of the path is to the walls. Nothing if there is
/// no such path.
std::optional<PlannedPath> plan_passage(const TerrainMap& terrain, const WallDistance& walls,
                                        const GoalField& goals, const Pose2& T_level_body,
                                        bool reverse, const Vehicle& vehicle,
                                        const PassageParams& params);

}  // namespace adit
