// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "common/config/bounds.hpp"
#include "common/sensing/spinning_lidar.hpp"

namespace adit {

/// Rings and columns of a simulated spinning lidar, by default those of a Velodyne VLP-16 at 20 Hz.
/// The errors of its ranges are those of LaserParams, of one ray per reading; mount, rate and range
/// limits those of the section `lasers`. All rings of a column fire at once.
struct SpinningLidarParams {
  int rings = 16;
  double elevation_min_rad = -0.2617993877991494;  ///< of the lowest ring: 15° down
  double elevation_max_rad =
      0.2617993877991494;  ///< of the highest ring; the others are evenly between
  int columns = 900;       ///< of a revolution
  /// Only each n-th revolution is simulated with all rings and sent on LIDAR. Of the others, which
  /// give the level view alone, only the readings are simulated that it needs.
  int decimation = 4;

  template <class V>
  void visit(V& v) {
    v("rings", rings, within(2, 256));
    v("elevation_min_rad", elevation_min_rad, within(-1.5, 1.5));
    v("elevation_max_rad", elevation_max_rad, within(-1.5, 1.5));
    v("columns", columns, within(90, 4096));
    v("decimation", decimation, at_least(1));
  }

  /// A revolution of `period_s` without ranges. It turns clockwise and begins behind.
  [[nodiscard]] LidarRevolution revolution(double period_s) const;
};

}  // namespace adit
