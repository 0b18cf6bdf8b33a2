// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace adit {

/// One ring of a spinning lidar: a laser that looks along a cone around the axis of the lidar.
struct LidarRing {
  float elevation_rad = 0.0F;       ///< above the plane across the axis
  float azimuth_offset_rad = 0.0F;  ///< after the azimuth of the column, since it fires later
  float time_offset_us = 0.0F;      ///< after the time of the column

  friend bool operator==(const LidarRing&, const LidarRing&) = default;
};

/// One firing of all rings.
struct LidarColumn {
  std::int32_t time_us = 0;  ///< after LidarRevolution::utime
  float azimuth_rad = 0.0F;  ///< counter-clockwise from the x axis of the lidar, any multiple of 2π

  friend bool operator==(const LidarColumn&, const LidarColumn&) = default;
};

/// One revolution of a spinning lidar, or a part of one, unfiltered, in the frame of the lidar: its
/// z axis is the axis of rotation.
struct LidarRevolution {
  std::int64_t utime = 0;            ///< time of the first column [µs since the epoch]
  std::vector<LidarRing> rings;      ///< of increasing elevation
  std::vector<LidarColumn> columns;  ///< in order of time
  /// [m], the rings of the first column, then those of the next; infinite without return, NaN where
  /// nothing was measured.
  std::vector<float> ranges_m;

  [[nodiscard]] float range_m(std::size_t column, std::size_t ring) const {
    return ranges_m[column * rings.size() + ring];
  }
  /// Unit vector along which a ring looks from a column.
  [[nodiscard]] Eigen::Vector3d direction(std::size_t column, std::size_t ring) const;
  /// Time at which a ring of a column measures [µs since the epoch].
  [[nodiscard]] std::int64_t utime_of(std::size_t column, std::size_t ring) const;

  friend bool operator==(const LidarRevolution&, const LidarRevolution&) = default;
};

}  // namespace adit
