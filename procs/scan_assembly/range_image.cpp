// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/scan_assembly/range_image.hpp"

#include <algorithm>
#include <iterator>
#include <limits>

namespace adit {
namespace {

float believed(float range_m, const LaserMount& mount) {
  if (range_m >= mount.range_max_m) return std::numeric_limits<float>::infinity();
  if (range_m >= mount.range_min_m) return range_m;
  return std::numeric_limits<float>::quiet_NaN();
}

}  // namespace

RangeImage range_image(std::span<const LaserScan> scans, const LaserMount& mount) {
  RangeImage image;
  image.reserve(scans.size());
  for (const LaserScan& scan : scans) {
    std::vector<float>& row = image.emplace_back();
    std::ranges::transform(scan.ranges_m, std::back_inserter(row),
                           [&](float range_m) { return believed(range_m, mount); });
  }
  return image;
}

}  // namespace adit
