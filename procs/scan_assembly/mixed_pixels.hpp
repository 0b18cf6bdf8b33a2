// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "common/config/bounds.hpp"
#include "common/sensing/laser_mount.hpp"
#include "common/sensing/laser_scan.hpp"

namespace adit {

/// The scans of a tilt sweep as an image: a row for each scan, a column for each beam. Ranges in
/// metres; infinity where nothing came back; NaN where the reading is not to be believed.
using RangeImage = std::vector<std::vector<float>>;

RangeImage range_image(std::span<const LaserScan> scans, const LaserMount& mount);

struct MixedPixelParams {
  double jump_min_m = 0.05;  ///< along the ray, from which two returns are not of one surface
  double span_max_m = 0.7;  ///< between surfaces that a laser may mix: a little more than its pulse
  int support_min = 1;      ///< returns in the lines before and after that make one believed

  template <class V>
  void visit(V& v) {
    v("jump_min_m", jump_min_m, above(0.0));
    v("span_max_m", span_max_m, above(0.0));
    v("support_min", support_min, at_least(0));
  }
};

/// Takes out returns that are of no surface; they become NaN. A beam that is cut by an edge returns
/// a range between those of both surfaces (a mixed pixel). Suspect is what differs along the ray
/// from both neighbours in its scan, and does not go on the straight line through the two returns
/// on either side, as a wall at grazing incidence does. Where a scan takes several turns of the
/// mirror (`turns`, ScanTiming) the laser tilts between neighbours, and it is enough that either
/// holds among the beams of one turn. Of these,
/// - what lies between its neighbours, nearer together than the span, is a mixture;
/// - what lies before both, or behind both, may be thin, as a cable, or wrong.
/// Either stays if it has support: as many returns at its range, no mixtures, among the three
/// nearest beams of the scans before and after. A cable crosses several of them; along an edge
/// there are mixtures above each other, which therefore do not count. Edges along the scan are not
/// looked for.
void remove_mixed_pixels(RangeImage& image, int turns, const MixedPixelParams& params);

}  // namespace adit
