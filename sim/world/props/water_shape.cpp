// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/props/water_shape.hpp"

#include <algorithm>

#include "sim/world/props/plan_box.hpp"
#include "sim/world/props/stretch.hpp"

namespace adit {

double water_level(const WaterDescription& water, const DriftLine& drift, const Heights& heights) {
  return std::min(heights.floor(drift.at(water.from_m).p_world),
                  heights.floor(drift.at(water.to_m).p_world));
}

HeightChange water_hollow(const WaterDescription& water, const DriftLine& drift, double level_m) {
  const auto apply = [water, drift, level_m](const Eigen::Vector2d& p_world, double floor_m) {
    const double share = share_of_stretch(drift, water.from_m, water.to_m, p_world);
    if (share < 0.0) return floor_m;
    const double hollow = 4.0 * share * (1.0 - share);
    return floor_m + hollow * (level_m - water.depth_m - floor_m);
  };
  const PlanBox box = box_around(stretch_outline(drift, water.from_m, water.to_m));
  return {box.low, box.high, apply};
}

}  // namespace adit
