// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "common/types/cloud.hpp"
#include "common/volume/voxel_grid.hpp"
#include "procs/volume_map/cell_set.hpp"

namespace adit {

/// The cells that a scan has seen.
struct ScanCells {
  CellSet free;                      ///< through which beams went; also those where others ended
  CellSet occupied;                  ///< in which beams ended
  std::int64_t rejected_points = 0;  ///< no numbers, or beyond the cube of the grid
};

/// Adds what the beams of a line say, from its origin to each of its points, all in the frame of
/// the grid. A beam that is longer than `range_max_m` is cut there, and meets nothing. A beam
/// without return says nothing: water and coal swallow beams at any distance.
///
/// The cells are those of octomap::OcTree::computeUpdate, bit for bit.
void add_line(const VoxelGrid& grid, const CloudLine& line, double range_max_m, ScanCells& cells);

}  // namespace adit
