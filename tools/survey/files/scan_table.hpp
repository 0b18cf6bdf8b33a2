// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace adit {

/// Where a 3D scan was taken, in the grid.
struct ScanPlace {
  std::int64_t number = 0;
  Eigen::Vector3d laser{0.0, 0.0, 0.0};  ///< place of the robot, elevation of the laser [m]
  /// Standard deviations relative to the scan before, 0 of the first.
  double step_sd_m = 0.0;  ///< of the place in plan, per axis
  double step_turn_sd_rad = 0.0;
  double step_z_sd_m = 0.0;
};

/// The layer `scans` of a survey's GeoPackage.
struct ScanTable {
  std::vector<ScanPlace> scans;
  std::string crs_wkt;   ///< of the grid, WKT 2
  std::string crs_name;  ///< for people
};

/// Reads the layer `scans` that `survey_layers` makes. Throws FileError with the path and the
/// reason.
ScanTable read_scan_table(const std::filesystem::path& path);

}  // namespace adit
