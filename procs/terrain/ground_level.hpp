// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "common/types/terrain_map.hpp"
#include "procs/terrain/terrain_params.hpp"

namespace adit {

/// Where the ground is to be expected, so that what hangs or stands over ground which is not seen,
/// the roof above all, is not taken for it.
class GroundLevel {
 public:
  /// Spreads from where the vehicle stands (z = 0) to the neighbours, and from these to theirs,
  /// over seen ground before all else. `low_m` are the lowest heights of the regions, row by row,
  /// NaN where there is none; they must outlive this. A region that is higher
  /// than its neighbour by more than ground may rise since it was last seen does not show the
  /// ground: the level goes on as it was, and what rises above it counts as height.
  GroundLevel(const TerrainMap& map, const std::vector<float>& low_m, const TerrainParams& params);

  [[nodiscard]] float at(std::size_t cell) const { return level_m_[cell]; }
  /// Of the ground where it is seen; else where it is to be expected.
  [[nodiscard]] float low_m(std::size_t cell) const {
    return is_seen(cell) ? low_m_[cell] : level_m_[cell];
  }
  /// Whether the lowest height of the region is the ground.
  [[nodiscard]] bool is_seen(std::size_t cell) const { return seen_[cell] != 0; }

 private:
  void start_below_vehicle(const TerrainMap& map, const Vehicle& vehicle);
  void spread(std::size_t columns);
  void visit_neighbours(std::size_t cell, std::size_t columns);
  void visit(std::size_t cell, std::size_t from);
  void enter(std::size_t cell, float level_m, std::size_t unseen);

  const std::vector<float>& low_m_;
  float step_m_;
  float rise_m_;  ///< of unseen ground, from one cell to the next
  std::vector<float> level_m_;
  std::vector<std::size_t> unseen_;  ///< cells since the ground was seen
  std::vector<std::uint8_t> seen_;
  std::vector<std::vector<std::size_t>> queues_;  ///< of cells to go on from, by `unseen_`
};

}  // namespace adit
