// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"
#include "common/grid/occupancy_grid.hpp"
#include "common/picture/canvas.hpp"

namespace adit {

// Around the map, in units of the sheet.
inline constexpr double kPageMargin = 40.0;
inline constexpr double kHeader = 76.0;
inline constexpr double kFooter = 84.0;
inline constexpr double kGraphKey = 104.0;  // width of each key of a pose graph

/// Where things go on the sheet.
struct MapLayout {
  /// Shows all that is known of the grid and these poses. `keys` are those of a pose graph that the
  /// foot of the sheet has to hold.
  MapLayout(const OccupancyGrid& grid, const std::vector<Pose2>& poses, int keys = 0);

  [[nodiscard]] Eigen::Vector2d pixel(const Eigen::Vector2d& p_map) const {
    return {left + (p_map.x() - low.x()) * pixels_per_metre,
            top + (high.y() - p_map.y()) * pixels_per_metre};
  }

  CellBox cells;
  Eigen::Vector2d low;  // corners of what is shown, in the map [m]
  Eigen::Vector2d high;
  double pixels_per_metre;
  double unit;  // what a pixel of lettering and lines is on this sheet
  double left;  // of the map on the sheet
  double top;
  int width;
  int height;
};

/// Height of the keys and the scale on the sheet [pixels].
inline double foot(const MapLayout& layout) { return layout.height - kFooter / 2.0 * layout.unit; }

/// Where a path starts and ends, in pixels. The start is larger, so that it shows where the end
/// lies upon it.
void draw_start(const Canvas& canvas, const Eigen::Vector2d& p, double unit);
void draw_end(const Canvas& canvas, const Eigen::Vector2d& p, double unit);

/// The foot of the sheet: the scale in metres at the left, and at the right what the colours of the
/// path mean. Returns where these begin, left of which there is room for more [pixels].
void draw_scale_bar(const Canvas& canvas, const MapLayout& layout);
double draw_path_keys(const Canvas& canvas, const MapLayout& layout, bool with_degenerate);

}  // namespace adit
