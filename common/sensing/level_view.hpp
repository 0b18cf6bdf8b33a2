// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "common/sensing/laser_mount.hpp"
#include "common/sensing/laser_scan.hpp"
#include "common/sensing/spinning_lidar.hpp"

namespace adit {

/// The scan of a planar laser that would stand level in the place of a spinning lidar, as stages
/// receive it on LASER_FRONT. A level beam lies between two rings. Where both hit one wall its
/// range is that of the straight line through their ends. Where they hit two surfaces, or ground or
/// roof that rises less than a wall, one of them counts if it is within 0.05 m of the level plane
/// and 5 m of the lidar, since it may be an obstacle; the nearer one, if both are. What is farther
/// is not known: the ring that is nearer to level would show a line on ground or roof that moves
/// with the robot. A ring that is level within 0.1° is used alone.
/// Level is level with the body, as for a planar laser: its attitude is not corrected.
class LevelView {
 public:
  explicit LevelView(const Lasers& lasers);

  /// A beam that no ring is near, or whose range is not known, is NaN; one of which both rings have
  /// no return is beyond `range_max_m`. The scan has the time of the first column.
  [[nodiscard]] LaserScan scan(const LidarRevolution& revolution);

  /// Which readings of a revolution with these rings and columns count for the scan, column by
  /// column.
  [[nodiscard]] std::vector<bool> readings_used(const LidarRevolution& revolution);

  /// Number of beams without a ring near them.
  [[nodiscard]] int beams_without_ring(const std::vector<LidarRing>& rings);

 private:
  /// A level beam in the frame of the lidar.
  struct Beam {
    double azimuth_rad = 0.0;
    double elevation_rad = 0.0;
    std::optional<std::size_t> below;  ///< ring at or below it; nothing if there is no ring near
    std::size_t above = 0;             ///< ring at or above it
  };
  /// Neighbouring columns, and where between them an azimuth is, 0 to 1.
  struct Place {
    std::size_t before = 0;
    std::size_t after = 0;
    double share = 0.0;
  };

  void find_rings(const std::vector<LidarRing>& rings);
  void sort_columns(const LidarRevolution& revolution);
  [[nodiscard]] std::optional<Place> place_of(double azimuth_rad) const;
  [[nodiscard]] double ring_range_m(const LidarRevolution& revolution, std::size_t ring,
                                    double azimuth_rad) const;
  [[nodiscard]] double range_m(const LidarRevolution& revolution, const Beam& beam) const;

  double step_rad_;
  double range_max_m_;
  std::vector<Beam> beams_;
  std::vector<LidarRing> rings_;  ///< for which the rings of the beams were found
  std::vector<std::pair<double, std::size_t>> columns_;  ///< of a revolution, by azimuth
};

}  // namespace adit
