// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "common/types/cloud.hpp"
#include "common/volume/voxel_grid.hpp"
#include "procs/volume_map/cell_set.hpp"

namespace adit {

/// The cells that a scan observed.
struct ScanCells {
  CellSet free;                      ///< traversed by beams; may contain occupied cells
  CellSet occupied;                  ///< in which beams end
  std::int64_t rejected_points = 0;  ///< not finite, or outside the grid
};

/// Adds the cells of the beams of a line, from its origin to each of its points, in the frame of
/// the grid (Hornung et al. 2013, section 5.1). A beam longer than `range_max_m` is truncated there
/// and adds no occupied cell. A beam without return adds nothing: water and coal absorb beams at
/// any range.
///
/// The cells are those of octomap::OcTree::computeUpdate, bit for bit.
void add_line(const VoxelGrid& grid, const CloudLine& line, double range_max_m, ScanCells& cells);

}  // namespace adit
