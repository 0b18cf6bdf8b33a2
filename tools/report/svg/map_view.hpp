// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <Eigen/Core>

#include "common/grid/occupancy_grid.hpp"
#include "tools/eval/trajectory.hpp"

namespace adit {

/// From map to a drawing: y down, in units of which there are about a thousand along the longer
/// side, so that lines and letters have the same size on every map.
class MapView {
 public:
  /// Shows all that is known of the grid (may be null) and the path.
  MapView(const OccupancyGrid* grid, const Trajectory& path);

  [[nodiscard]] Eigen::Vector2d at(const Eigen::Vector2d& p_map) const {
    return {(p_map.x() - low_.x()) * units_per_metre_, (high_.y() - p_map.y()) * units_per_metre_};
  }
  [[nodiscard]] double units_per_metre() const { return units_per_metre_; }
  [[nodiscard]] double width() const { return (high_.x() - low_.x()) * units_per_metre_; }
  [[nodiscard]] double height() const { return (high_.y() - low_.y()) * units_per_metre_; }
  /// p_map of the corners of what is shown [m].
  [[nodiscard]] const Eigen::Vector2d& low() const { return low_; }
  [[nodiscard]] const Eigen::Vector2d& high() const { return high_; }

 private:
  Eigen::Vector2d low_;
  Eigen::Vector2d high_;
  double units_per_metre_;
};

/// The grid as an image of the drawing: open ground white, walls dark, the unknown see-through.
/// Cells are joined where there are more of them than a screen shows.
std::string ground_svg(const OccupancyGrid& grid, const MapView& view);

/// A bar with its length, its left end at a place [units].
std::string scale_svg(const MapView& view, const Eigen::Vector2d& left);

}  // namespace adit
