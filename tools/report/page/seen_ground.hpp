// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "common/grid/occupancy_grid.hpp"
#include "tools/eval/trajectory.hpp"

namespace adit {

/// How far free ground was seen from a pose of the path onwards [m]: the largest distance from it
/// to a free cell that is connected with it beside the driven path. `path` is T_map_body.
double seen_beyond_m(const OccupancyGrid& grid, const Trajectory& path,
                     const Eigen::Vector2d& p_map);

}  // namespace adit
