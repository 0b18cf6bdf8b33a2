// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/sensing/spinning_lidar.hpp"

#include <cmath>

namespace adit {

Eigen::Vector3d LidarRevolution::direction(std::size_t column, std::size_t ring) const {
  const double azimuth =
      double{columns[column].azimuth_rad} + double{rings[ring].azimuth_offset_rad};
  const double elevation = rings[ring].elevation_rad;
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
          std::sin(elevation)};
}

std::int64_t LidarRevolution::utime_of(std::size_t column, std::size_t ring) const {
  return utime + columns[column].time_us + std::lround(rings[ring].time_offset_us);
}

}  // namespace adit
