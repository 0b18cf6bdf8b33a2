// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/grid/grid2.hpp"
#include "common/grid/ground_trend.hpp"
#include "common/types/cloud.hpp"
#include "common/types/terrain_map.hpp"

namespace adit {

/// Whether a point is a valid laser return: finite, and within a kilometre of the origin.
bool is_usable(const Eigen::Vector3f& p_level);

/// Number of points and misses of a cloud that are not usable, and therefore skipped.
std::size_t unusable_points(const Cloud& cloud);

/// Maps points in level to cells of a map.
class CellFinder {
 public:
  explicit CellFinder(const TerrainMap& map)
      : corner_(map.p_level_corner.cast<float>()),
        cells_per_m_(static_cast<float>(1.0 / map.cell_m)),
        columns_(map.cells.columns()),
        rows_(map.cells.rows()) {}

  static constexpr int kOutside = -1;
  /// Index of the cell, row by row, or kOutside. Coordinates must be finite.
  [[nodiscard]] int at(float x, float y) const {
    const float u = (x - corner_.x()) * cells_per_m_;
    const float v = (y - corner_.y()) * cells_per_m_;
    if (!(u >= 0.0F && v >= 0.0F)) return kOutside;
    if (u >= static_cast<float>(columns_) || v >= static_cast<float>(rows_)) return kOutside;
    return static_cast<int>(v) * columns_ + static_cast<int>(u);
  }

 private:
  Eigen::Vector2f corner_;
  float cells_per_m_;
  int columns_;
  int rows_;
};

/// Heights of the points of a cloud, sorted by cell, each moved to the centre of its cell along the
/// trend of the ground: a slope within a cell is no difference of heights.
class CellHeights {
 public:
  CellHeights(const Cloud& cloud, const TerrainMap& map);

  /// z in level [m] of the points in a cell.
  [[nodiscard]] std::span<const float> in(int column, int row) const {
    const std::size_t cell = lowest_m_.index({column, row});
    return std::span(heights_).subspan(starts_[cell], starts_[cell + 1] - starts_[cell]);
  }

  /// The lowest height in a cell [m]; infinite without points.
  [[nodiscard]] float lowest_m(int column, int row) const { return lowest_m_.at({column, row}); }
  [[nodiscard]] const GroundTrend& trend() const { return trend_; }

 private:
  GroundTrend trend_;
  Grid2<float> lowest_m_;
  std::vector<std::uint32_t> starts_;  ///< start of the heights of each cell, and the end
  std::vector<float> heights_;
};

}  // namespace adit
