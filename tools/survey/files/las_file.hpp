// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include <Eigen/Core>

namespace adit {

/// A point of a LAS file.
struct LasPoint {
  Eigen::Vector3d p{0.0, 0.0, 0.0};  ///< easting, northing, elevation [m]
  std::int64_t utime = 0;            ///< [µs since the epoch, UTC]
  std::uint32_t scan = 0;            ///< number of its 3D scan
  float plan_sd_m = 0.0F;            ///< standard deviation in plan, in the worst direction
  float z_sd_m = 0.0F;               ///< and of the elevation
};

/// Calls a visitor with each point of a cloud; the same points in the same order each time.
using LasPoints = std::function<void(const std::function<void(const LasPoint&)>&)>;

/// Writes LAS 1.4 (American Society for Photogrammetry and Remote Sensing, "LAS specification 1.4 –
/// R15", 2019) with points of format 6, coordinates in whole millimetres, adjusted standard GPS
/// time, the number of the 3D scan as point source, and the attributes `scan`, `sd_plan` and `sd_z`
/// as extra bytes. The lasers measure no intensity: it is 0. `crs_wkt1`: of the coordinates, in
/// WKT 1, as the specification asks. Throws FileError if the file cannot be written, or if the
/// points are more than 2,000 km apart.
void write_las(const LasPoints& points, const std::string& crs_wkt1,
               const std::filesystem::path& path);

/// Seconds of GPS time at a time, less 10⁹ (table of leap seconds up to that of 2017).
double adjusted_gps_time(std::int64_t utime);

}  // namespace adit
