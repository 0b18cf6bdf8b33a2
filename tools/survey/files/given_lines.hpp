// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace adit {

/// A line, the boundary of an area, or a point of another survey: other workings, a property line,
/// a borehole.
struct GivenLine {
  std::string layer;
  std::string name;                     ///< of its attributes, or its number
  std::vector<Eigen::Vector2d> points;  ///< in the grid; one: a point; areas repeat the first
  bool is_area = false;
};

/// The features of a vector file in any format that GDAL reads (GeoPackage, shape file, DXF,
/// GeoJSON, ..). Layers of another coordinate system are transformed into `crs_wkt`; those without
/// one are taken to be in it. Throws std::runtime_error with one line for a file that cannot be
/// read, has no feature, or whose system nothing ties to `crs_wkt`.
std::vector<GivenLine> read_given_lines(const std::filesystem::path& path,
                                        const std::string& crs_wkt);

}  // namespace adit
