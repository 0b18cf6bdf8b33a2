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

/// A pose graph to draw over a map, in the map frame.
struct GraphPicture {
  struct Edge {
    Eigen::Vector2d a;  ///< [m]
    Eigen::Vector2d b;  ///< [m]
  };

  std::vector<Pose2> nodes;         ///< T_map_local, small dots
  std::vector<Edge> sequential;     ///< between consecutive local maps, thin
  std::vector<Edge> loop_closures;  ///< in force
  std::vector<Edge> revoked;        ///< once in force and revoked, dashed

  [[nodiscard]] bool empty() const {
    return nodes.empty() && sequential.empty() && loop_closures.empty() && revoked.empty();
  }
};

/// The content drawn over a map, in the map frame.
struct MapPicture {
  /// A place that is marked.
  struct Place {
    enum class Kind {
      kScan,      ///< of a 3D scan
      kJunction,  ///< of corridors
      kDeadEnd,
      kBlockedFrontier,  ///< that is closed, by its evidence, without being explored
      kOpenFrontier,
      kAppeared,  ///< a wall that earlier runs did not see; of each cell
      kVanished,  ///< one that later runs did not see
      kDiffers,   ///< seen by some runs only
    };

    Eigen::Vector2d p_map{0.0, 0.0};
    Kind kind = Kind::kScan;
  };

  std::string title;        ///< one line, UTF-8
  std::vector<Pose2> path;  ///< T_map_body from start to end, finite, coloured along its length
  std::vector<bool> degenerate;  ///< for each pose of the path, or empty; drawn as a wide band
  /// Indices of poses at which a new session begins: no line leads to them.
  std::vector<std::size_t> jumps{};
  GraphPicture graph{};  ///< the parts to draw
  /// For each pose of the path, whether the map may be wrong there, or empty; drawn as a wide band.
  std::vector<bool> doubtful{};
  std::vector<Place> places{};
};

/// Draws a map as PNG: free cells white, walls dark, unknown cells in the colour of the paper; the
/// path with its start and end, the places, and the pose graph; below a scale bar and a legend. At
/// most 2400 pixels a side. The same map gives the same bytes on the same system (with the same
/// fonts). Throws std::runtime_error if the file cannot be written.
void write_map_png(const OccupancyGrid& grid, const MapPicture& picture,
                   const std::filesystem::path& path);

}  // namespace adit
