// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/props/add_prop.hpp"
#include "sim/world/props/circle.hpp"
#include "sim/world/props/placement.hpp"

namespace adit {

// The hole itself is in the floor already (change_heights).
void add_prop(const PitDescription& pit, PropSite& site) {
  const DriftLine& drift = drift_with(site.drifts, pit.drift, pit.at_m, site.what);
  const Eigen::Vector2d middle = drift.beside(pit.at_m, pit.across_m);
  const double bottom_m = site.heights.floor(middle);
  site.world.truth.obstacles.push_back({.kind = PartKind::kFloor,
                                        .name = pit.name,
                                        .outline = around_circle(middle, pit.radius_m),
                                        .z_low_m = bottom_m,
                                        .z_high_m = bottom_m + pit.depth_m});
}

}  // namespace adit
