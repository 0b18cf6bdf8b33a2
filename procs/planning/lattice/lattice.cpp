// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/lattice/lattice.hpp"

#include <cmath>

namespace adit {
namespace {

constexpr double kStartRadiusM = 0.6;  // around the start

bool meets(const std::vector<std::uint8_t>& layer, const RunKernel& kernel,
           const GroundLayers& layers, int column, int row) {
  for (const RunKernel::Run& run : kernel.runs) {
    const int y = row + run.row;
    if (y < 0 || y >= layers.rows) continue;
    for (int dx = run.first; dx <= run.last; ++dx) {
      const int x = column + dx;
      if (x >= 0 && x < layers.columns && layer[layers.index(x, y)] != 0) return true;
    }
  }
  return false;
}

}  // namespace

LatticePose nearest_pose(const TerrainMap& terrain, const HeadingSet& headings,
                         const Pose2& T_level_body) {
  const Eigen::Vector2d cells =
      (T_level_body.translation() - terrain.p_level_corner) / terrain.cell_m;
  // What is not finite is nowhere, and beyond what an int holds lies no cell either.
  const bool somewhere = T_level_body.vector().allFinite() && cells.cwiseAbs().maxCoeff() < 1e6;
  if (!somewhere) return {-1, -1, 0};
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
        std::uint16_t& here = space.slice(k)[space.index(column, row)];
        if (here != CSpace::kLethal && !CSpace::is_marginal(here)) continue;
        if (meets(layers.under_body, kernel.start_body, layers, column, row)) continue;
        if (meets(layers.under_wheels, kernel.start_wheels, layers, column, row)) continue;
        here = cost;
      }
    }
  }
}

}  // namespace adit
