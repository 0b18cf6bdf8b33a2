// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "common/grid/grid2.hpp"
#include "common/grid/occupancy_grid.hpp"
#include "tools/eval/trajectory.hpp"

namespace adit {

/// The ground of a map that was seen beyond the driven path.
class SeenGround {
 public:
  /// `path` is T_map_body. `grid` must outlive this.
  SeenGround(const OccupancyGrid& grid, const Trajectory& path);

  /// How far free ground was seen from a pose of the path onwards [m]: the largest distance from it
  /// to a free cell that is connected with it beside the driven path.
  [[nodiscard]] double beyond_m(const Eigen::Vector2d& p_map) const;

 private:
  void mark_driven(const Eigen::Vector2i& centre);

  const OccupancyGrid& grid_;
  Grid2<std::uint8_t> driven_;  ///< 1 near the path
};

}  // namespace adit
