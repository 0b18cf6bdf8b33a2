// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <Eigen/Core>

#include "common/grid/occupancy_grid.hpp"
#include "tools/eval/trajectory.hpp"

namespace adit {

/// Transforms map coordinates to those of a drawing: y down, about 1000 units along the longer
/// side, so that lines and letters have the same size on every map.
class MapView {
 public:
  /// Fits the observed cells of the grid (may be null) and the path.
  MapView(const OccupancyGrid* grid, const Trajectory& path);

  [[nodiscard]] Eigen::Vector2d at(const Eigen::Vector2d& p_map) const {
    return {(p_map.x() - low_.x()) * units_per_metre_, (high_.y() - p_map.y()) * units_per_metre_};
  }
  [[nodiscard]] double units_per_metre() const { return units_per_metre_; }
  [[nodiscard]] double width() const { return (high_.x() - low_.x()) * units_per_metre_; }
  [[nodiscard]] double height() const { return (high_.y() - low_.y()) * units_per_metre_; }

 private:
  Eigen::Vector2d low_;  // p_map of the corners
  Eigen::Vector2d high_;
  double units_per_metre_;
};

/// The grid as an <image>: free cells white, walls dark, unknown cells transparent. Blocks of cells
/// become one pixel if the grid has more cells than a screen has pixels.
std::string ground_svg(const OccupancyGrid& grid, const MapView& view);

/// A scale bar with its left end at `left` [units].
std::string scale_svg(const MapView& view, const Eigen::Vector2d& left);

}  // namespace adit
