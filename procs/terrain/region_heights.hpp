// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "procs/terrain/cell_heights.hpp"
#include "procs/terrain/terrain_params.hpp"

namespace adit {

/// Heights of the overlapping regions (paper, section 3.1): 3 × 3 cells around each cell. Heights
/// are moved to the centre of the region along the trend of the ground.
class RegionHeights {
 public:
  /// Heights above the ground of a region.
  struct Above {
    float high_m = 0.0F;      ///< highest within the headroom; the ground itself if there is none
    float roof_m = 0.0F;      ///< lowest above the headroom; infinite if there is none
    std::uint32_t count = 0;  ///< points within the headroom
  };

  /// `heights` must outlive this object.
  RegionHeights(const CellHeights& heights, const TerrainMap& map, const TerrainParams& params);

  /// The lowest height of a region [m]; NaN without points.
  [[nodiscard]] float low_m(int column, int row) const;
  [[nodiscard]] Above above(int column, int row, float ground_m) const;

 private:
  /// First and last column and row of a region.
  struct Extent {
    int left, right, bottom, top;
  };
  [[nodiscard]] Extent extent(int column, int row) const;
  /// Visits the cells of a region, with the rise of the trend from its centre to them [m].
  template <class Visit>
  void visit_cells(int column, int row, const Visit& visit) const;
  template <class Visit>
  void visit(int column, int row, const Visit& visit) const;
  [[nodiscard]] float least_m(int column, int row) const;
  [[nodiscard]] int rank(std::uint32_t count) const;

  const CellHeights& heights_;
  int columns_;
  int rows_;
  float headroom_m_;
  int k_;
  int points_per_rank_;
};

}  // namespace adit
