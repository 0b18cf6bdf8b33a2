// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/lattice/lattice.hpp"

#include <cmath>

namespace adit {
namespace {

constexpr double kStartRadiusM = 0.6;

/// Whether a kernel centred at a cell overlaps a marked cell of a layer.
bool overlaps(const CellLayer& layer, const RunKernel& kernel, int column, int row) {
  for (const RunKernel::Run& run : kernel.runs) {
    for (int dx = run.first; dx <= run.last; ++dx) {
      if (layer.get({column + dx, row + run.row}) != 0) return true;
    }
  }
  return false;
}

}  // namespace

LatticePose nearest_pose(const TerrainMap& terrain, const HeadingSet& headings,
                         const Pose2& T_level_body) {
  const Eigen::Vector2d cells =
      (T_level_body.translation() - terrain.p_level_corner) / terrain.cell_m;
  // The cast to int needs finite values in its range.
  const bool is_valid = T_level_body.vector().allFinite() && cells.cwiseAbs().maxCoeff() < 1e6;
  if (!is_valid) return {-1, -1, 0};
  return {static_cast<int>(std::floor(cells.x())), static_cast<int>(std::floor(cells.y())),
          headings.nearest(T_level_body.theta)};
}

void clear_start(CSpace& space, const LatticePose& start, const GroundLayers& layers,
                 const CSpaceKernels& kernels, std::uint16_t cost) {
  const int reach = static_cast<int>(kStartRadiusM / layers.cell_m);
  for (int k = 0; k < space.headings() / 2; ++k) {
    const auto& kernel = kernels.oriented(k);
    for (int row = start.row - reach; row <= start.row + reach; ++row) {
      for (int column = start.column - reach; column <= start.column + reach; ++column) {
        if (!space.contains(column, row)) continue;
        std::uint16_t& pose_cost = space.slice(k).at({column, row});
        if (pose_cost != CSpace::kLethal && !CSpace::is_marginal(pose_cost)) continue;
        if (overlaps(layers.under_body, kernel.start_body, column, row)) continue;
        if (overlaps(layers.under_wheels, kernel.start_wheels, column, row)) continue;
        pose_cost = cost;
      }
    }
  }
}

}  // namespace adit
