// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <limits>

#include "sim/world/props/add_prop.hpp"
#include "sim/world/props/convex_outline.hpp"
#include "sim/world/props/placement.hpp"
#include "sim/world/props/stretch.hpp"

namespace adit {

// The roof itself hangs low already (change_heights).
void add_prop(const LowRoofDescription& low, PropSite& site) {
  const DriftLine& drift = drift_with(site.drifts, low.drift, low.from_m, low.to_m, site.what);
  Obstacle obstacle{.kind = PartKind::kRoof,
                    .name = low.name,
                    .outline = convex_outline(stretch_outline(drift, low.from_m, low.to_m)),
                    .z_low_m = std::numeric_limits<double>::infinity(),
                    .z_high_m = -std::numeric_limits<double>::infinity()};
  for (const double s_m : places_between(low.from_m, low.to_m, 0.2)) {
    for (const double across_m : places_between(-drift.width_m / 2.0, drift.width_m / 2.0, 0.2)) {
      const double roof_m = site.heights.roof(drift.beside(s_m, across_m));
      obstacle.z_low_m = std::min(obstacle.z_low_m, roof_m);
      obstacle.z_high_m = std::max(obstacle.z_high_m, roof_m);
    }
  }
  site.world.truth.obstacles.push_back(std::move(obstacle));
}

}  // namespace adit
