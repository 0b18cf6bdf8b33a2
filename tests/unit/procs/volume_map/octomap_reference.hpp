// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <ostream>
#include <vector>

#include <octomap/OcTree.h>

#include "common/types/cloud.hpp"
#include "common/volume/voxel_grid.hpp"
#include "procs/volume_map/occupancy_tree.hpp"
#include "procs/volume_map/scan_cells.hpp"

namespace adit::test {

/// The cells of OctoMap: computeUpdate for each line with its own origin; a cell that is occupied
/// for any line is not free. Cells along the curve.
struct OctoMapCells {
  std::vector<VoxelCode> free;
  std::vector<VoxelCode> occupied;

  friend bool operator==(const OctoMapCells&, const OctoMapCells&) = default;
};
OctoMapCells octomap_cells(const Cloud& cloud, double cell_m, double range_max_m);

/// The same from our implementation.
OctoMapCells our_cells(const Cloud& cloud, double cell_m, double range_max_m);

/// Calls updateNode for each of these cells.
void insert(const OctoMapCells& cells, octomap::OcTree& tree);

struct Leaf {
  VoxelCode first = 0;
  unsigned depth = 0;
  float log_odds = 0.0F;

  friend bool operator==(const Leaf&, const Leaf&) = default;
};
std::ostream& operator<<(std::ostream& out, const Leaf& leaf);

/// In order along the curve.
std::vector<Leaf> leaves(const octomap::OcTree& tree);
/// Through a file.
std::vector<Leaf> leaves(const OccupancyTree& tree, const std::filesystem::path& scratch);

}  // namespace adit::test
