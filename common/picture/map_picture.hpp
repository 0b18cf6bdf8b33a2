// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"
#include "common/grid/occupancy_grid.hpp"

namespace adit {

/// A pose graph to be drawn over a map, in the map's frame.
struct GraphPicture {
  struct Edge {
    Eigen::Vector2d a;  ///< [m]
    Eigen::Vector2d b;  ///< [m]
  };

  std::vector<Pose2> nodes;         ///< T_map_local, small dots
  std::vector<Edge> sequential;     ///< between consecutive local maps, thin
  std::vector<Edge> loop_closures;  ///< in force
  std::vector<Edge> revoked;        ///< once in force and given up, dashed

  [[nodiscard]] bool empty() const {
    return nodes.empty() && sequential.empty() && loop_closures.empty() && revoked.empty();
  }
};

/// What is drawn over a map, in the map's frame.
struct MapPicture {
  std::string title;        ///< one line, UTF-8
  std::vector<Pose2> path;  ///< T_map_body from start to end, finite, coloured along its length
  std::vector<bool> degenerate;  ///< for each pose of the path, or empty; drawn as a wide band
  /// Indices of poses to which the path does not lead: there another session begins.
  std::vector<std::size_t> jumps{};
  GraphPicture graph{};  ///< as much of it as is to be seen
};

/// Draws a map as PNG: open ground white, walls dark, the unknown the colour of the paper; the path
/// with its start and end, and the pose graph; below it a scale bar and what the colours mean. At
/// most 2400 pixels either way. The same map gives the same bytes on the same system (fonts are the
/// system's). Throws std::runtime_error where the file cannot be written.
void write_map_png(const OccupancyGrid& grid, const MapPicture& picture,
                   const std::filesystem::path& path);

}  // namespace adit
