// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "common/config/bounds.hpp"
#include "common/sensing/laser_mount.hpp"
#include "common/sensing/laser_scan.hpp"
#include "common/sensing/spinning_lidar.hpp"

namespace adit {

/// The ranges of a tilt sweep [m]: a row for each scan, a column for each beam. Infinity where a
/// beam had no return; NaN where the reading is invalid.
using RangeImage = std::vector<std::vector<float>>;

RangeImage range_image(std::span<const LaserScan> scans, const LaserMount& mount);
/// The ranges of a revolution of a spinning lidar: a row for each ring, a column for each of its.
RangeImage range_image(const LidarRevolution& revolution, const LaserMount& mount);

struct MixedPixelParams {
  double jump_min_m = 0.05;  ///< range difference between returns of two surfaces
  double span_max_m = 0.7;   ///< distance of surfaces that are mixed: slightly above a pulse length
  int support_min = 1;       ///< returns in the neighbouring lines that confirm one

  template <class V>
  void visit(V& v) {
    v("jump_min_m", jump_min_m, above(0.0));
    v("span_max_m", span_max_m, above(0.0));
    v("support_min", support_min, at_least(0));
  }
};

/// Removes returns that belong to no surface; they become NaN. A beam that is split by an edge
/// returns a range between those of the two surfaces (a mixed pixel). A return is suspect if its
/// range differs from both neighbours in its scan, and if it does not continue the line through the
/// next two returns on either side, as those of a wall at grazing incidence do. If a scan takes
/// several turns of the mirror (`turns`, ScanTiming), the laser tilts between neighbouring beams:
/// it is sufficient that one of the conditions fails among the beams of the same turn. Of the
/// suspects,
/// - a return between neighbours that are closer together than the span is a mixture;
/// - a return in front of both neighbours, or behind both, is isolated: a thin object such as a
///   cable, or an error.
/// Both are kept with support: returns of the same range that are no mixtures among the three
/// nearest beams of the scans before and after. A cable crosses several scans; along an edge,
/// mixtures lie above each other, and therefore do not count. Edges along the scan are not
/// detected.
void remove_mixed_pixels(RangeImage& image, int turns, const MixedPixelParams& params);

}  // namespace adit
