// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"
#include "common/grid/occupancy_grid.hpp"
#include "common/picture/canvas.hpp"

namespace adit {

// Margins of the map, in units of the sheet.
inline constexpr double kPageMargin = 40.0;
inline constexpr double kHeader = 76.0;
inline constexpr double kFooter = 84.0;
inline constexpr double kGraphKey = 104.0;  // width of each legend entry of a pose graph

/// The layout of a map sheet.
struct MapLayout {
  /// Fits all observed cells of the grid and these poses. `keys`: number of legend entries of the
  /// pose graph in the footer.
  MapLayout(const OccupancyGrid& grid, const std::vector<Pose2>& poses, int keys = 0);

  [[nodiscard]] Eigen::Vector2d pixel(const Eigen::Vector2d& p_map) const {
    return {left + (p_map.x() - low.x()) * pixels_per_metre,
            top + (high.y() - p_map.y()) * pixels_per_metre};
  }

  CellBox cells;
  Eigen::Vector2d low;  // corners of the shown area, in the map [m]
  Eigen::Vector2d high;
  double pixels_per_metre;
  double unit;  // scale of lettering and lines on this sheet
  double left;  // left edge of the map on the sheet
  double top;
  int width;
  int height;
};

/// Vertical position of legend and scale bar on the sheet [pixels].
inline double foot(const MapLayout& layout) { return layout.height - kFooter / 2.0 * layout.unit; }

/// Draws the start and end of a path, in pixels. The start marker is larger, so that it remains
/// visible below the end marker.
void draw_start(const Canvas& canvas, const Eigen::Vector2d& p, double unit);
void draw_end(const Canvas& canvas, const Eigen::Vector2d& p, double unit);

/// Draw the footer: the scale bar at the left, and the legend of the path at the right.
/// draw_path_keys returns the left end of the legend, up to which there is space [pixels].
void draw_scale_bar(const Canvas& canvas, const MapLayout& layout);
double draw_path_keys(const Canvas& canvas, const MapLayout& layout, bool with_degenerate,
                      bool with_doubtful = false);

}  // namespace adit
