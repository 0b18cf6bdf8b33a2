// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace adit {

/// A band of a raster: a value for each cell, rows from north to south; NaN: nothing is known.
struct RasterBand {
  std::string description;
  std::string unit;  ///< "m", or empty
  std::vector<float> values;
};

/// A raster whose cells are squares along the axes of its coordinate system.
struct Raster {
  int columns = 0;
  int rows = 0;
  double cell_m = 0.0;
  Eigen::Vector2d north_west{0.0, 0.0};  ///< outer corner of the first cell
  std::vector<RasterBand> bands;
};

/// Writes a compressed GeoTIFF with a coordinate system as WKT. Throws FileError.
void write_geotiff(const Raster& raster, const std::string& crs_wkt,
                   const std::filesystem::path& path);

}  // namespace adit
