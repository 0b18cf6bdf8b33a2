// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "common/sensing/laser_mount.hpp"
#include "common/sensing/laser_scan.hpp"
#include "common/sensing/spinning_lidar.hpp"

namespace adit {

/// The scan of a planar laser that would stand level in the place of a spinning lidar, as stages
/// receive it on LASER_FRONT. A level beam lies between two rings. Where both hit one wall its
/// range is that of the straight line through their ends. A ring that is level within 0.1° is used
/// alone. What else the rings show counts within 3 m, since it may be an obstacle: a surface that
/// leans more than 27° from upright; where they hit two surfaces, or one that leans more than 56°,
/// the end of a ring within 0.05 m of the level plane, the nearer one of two. Farther away the
/// range of such a beam is not known: on ground, roof or the face of a heap it changes with the
/// attitude of the body, and that of the ring nearer to level moves with the robot. Level is level
/// with the body, as for a planar laser: its attitude is not corrected.
class LevelView {
 public:
  /// Up to which surfaces count that are no walls; a robot must stop within it.
  static constexpr double kObstacleReachM = 3.0;

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
    // Two rings that show how the surface leans: these, or a level one and its neighbour.
    std::size_t below_of_plane = 0;
    std::size_t above_of_plane = 0;
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
  [[nodiscard]] bool is_steep(const LidarRevolution& revolution, const Beam& beam, double r1,
                              double r2) const;
  [[nodiscard]] double range_m(const LidarRevolution& revolution, const Beam& beam) const;

  double step_rad_;
  double range_max_m_;
  Eigen::Vector3d up_lidar_;
  std::vector<Beam> beams_;
  std::vector<LidarRing> rings_;  ///< for which the rings of the beams were found
  std::vector<std::pair<double, std::size_t>> columns_;  ///< of a revolution, by azimuth
};

}  // namespace adit
