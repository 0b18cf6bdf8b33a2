// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include <Eigen/Core>

namespace adit {

/// The coordinate system of a grid of eastings and northings in metres.
struct GridSystem {
  std::string wkt;
  std::string name;           ///< "WGS 84 / UTM zone 32N"
  std::string crs_name;       ///< for GeoJSON
  bool is_projected = false;  ///< tied to the earth
};

/// By its code, "EPSG:n", or "local": a mine's own grid. Throws std::runtime_error with one line
/// for a code that is unknown, or a system without eastings and northings in metres.
GridSystem grid_system(const std::string& crs);

/// The grid at a place, by PROJ.
struct GridFactors {
  double scale = 1.0;            ///< length in the grid over that on the ellipsoid
  double convergence_rad = 0.0;  ///< of grid north, clockwise from true north
  double longitude_deg = 0.0;
  double latitude_deg = 0.0;
  bool in_area = true;  ///< of use of the coordinate system
};

/// Nothing for a system that is not projected, or outside of the projection.
std::optional<GridFactors> grid_factors(const GridSystem& grid, const Eigen::Vector2d& p_grid);

}  // namespace adit
