// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/grid/occupancy_grid.hpp"
#include "common/types/exploration.hpp"
#include "tools/eval/trajectory.hpp"
#include "tools/report/svg/map_svg.hpp"

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

// Layers of the map of a mission, one <g> each; empty without content. `page` is the file that
// links refer to; empty for the page that contains the map.

/// The grid as an <image>: free cells white, walls dark, unknown cells transparent. Blocks of cells
/// become one pixel if the grid has more cells than a screen has pixels.
std::string ground_svg(const OccupancyGrid& grid, const MapView& view);
std::string corridors_svg(const CorridorGraph& graph, const MapView& view);
std::string graph_svg(const MissionMap& map, const MapView& view);
/// Outbound and return path. They mostly overlap, therefore the return path is thin and dashed.
std::string paths_svg(const Trajectory& path, const std::optional<std::int64_t>& return_home_utime,
                      const MapView& view);
std::string frontiers_svg(const std::vector<Frontier>& frontiers, const MapView& view,
                          const std::string& page);
/// Numbers to the left of the scan direction, so that those of the return path are on the other
/// side of the tunnel.
std::string scans_svg(const std::vector<ScanMark>& scans, const MapView& view,
                      const std::string& page);
/// First and last position.
std::string ends_svg(const Trajectory& path, const MapView& view);
/// A scale bar with its left end at `left` [units].
std::string scale_svg(const MapView& view, const Eigen::Vector2d& left);

}  // namespace adit
