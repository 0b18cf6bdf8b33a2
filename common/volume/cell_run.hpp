// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/volume/voxel_grid.hpp"

namespace adit {

/// Cells that follow each other along the curve and are all of one kind.
struct CellRun {
  VoxelCode first = 0;
  VoxelCode end = 0;  ///< behind the last
  bool occupied = false;

  friend bool operator==(const CellRun&, const CellRun&) = default;
};

}  // namespace adit
