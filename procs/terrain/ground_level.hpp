// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "common/grid/ground_trend.hpp"
#include "common/types/terrain_map.hpp"
#include "procs/terrain/terrain_params.hpp"

namespace adit {

/// What the points of each region show of its ground, row by row.
struct RegionGround {
  std::vector<float> low_m;         ///< lowest height that may be ground; NaN if there is none
  std::vector<std::uint8_t> steep;  ///< 1: the points rise by more than a step: rock, or its face
};

/// Estimates the height of the ground in every cell, so that obstacles and roof over unobserved
/// ground are not mistaken for ground.
class GroundLevel {
 public:
  /// Propagates the level from below the vehicle (z = 0 at the origin) from neighbour to neighbour
  /// along the trend of the ground, over observed ground first. `regions` and `trend` must outlive
  /// this object. A region that is higher than expected from its neighbour by more than ground can
  /// rise since it was last observed does not show the ground: the level continues along the trend,
  /// and what rises above it counts as height. Rock bounds the ground before it from above only:
  /// its foot may be hidden.
  GroundLevel(const TerrainMap& map, const RegionGround& regions, const GroundTrend& trend,
              const TerrainParams& params);

  [[nodiscard]] float at(std::size_t cell) const { return level_m_[cell]; }
  [[nodiscard]] const GroundTrend& trend() const { return trend_; }
  /// Height of the ground where it is observed, otherwise the expected level.
  [[nodiscard]] float low_m(std::size_t cell) const {
    return is_observed(cell) ? low_m_[cell] : level_m_[cell];
  }
  /// Least height that passable ground can have: that of observed ground; elsewhere it may have
  /// fallen from the expected level since it was last observed, as steeply as vehicles drive.
  [[nodiscard]] float least_m(std::size_t cell) const {
    return is_observed(cell) ? low_m_[cell]
                             : level_m_[cell] - fall_m_ * static_cast<float>(unobserved_[cell]);
  }
  /// Whether the lowest height of the region is the ground.
  [[nodiscard]] bool is_observed(std::size_t cell) const { return observed_[cell] != 0; }

 private:
  void start_below_vehicle(const TerrainMap& map, const Vehicle& vehicle);
  void spread(std::size_t columns);
  void visit_neighbours(std::size_t cell, std::size_t columns);
  /// `ahead`: from the cell `from` to its neighbour `cell`.
  void visit(std::size_t cell, std::size_t from, const Eigen::Vector2f& ahead);
  void enter(std::size_t cell, float level_m, std::size_t unobserved);

  const std::vector<float>& low_m_;
  const std::vector<std::uint8_t>& steep_;
  const GroundTrend& trend_;
  float step_m_;
  float rise_m_;  ///< maximal rise of unobserved ground per cell, beyond the trend
  float fall_m_;  ///< likewise, maximal fall
  std::vector<float> level_m_;
  std::vector<std::size_t> unobserved_;  ///< cells since the last observed ground
  std::vector<std::uint8_t> observed_;
  std::vector<std::vector<std::size_t>> queues_;  ///< cells to propagate from, by `unobserved_`
};

}  // namespace adit
