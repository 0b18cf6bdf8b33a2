// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/props/add_prop.hpp"
#include "sim/world/props/placement.hpp"

namespace adit {

void add_prop(const GasDescription& gas, PropSite& site) {
  const DriftLine& drift = drift_with(site.drifts, gas.drift, gas.at_m, site.what);
  site.world.gas.push_back({gas.name, drift.at(gas.at_m).p_world, gas.radius_m, gas.methane_share});
}

}  // namespace adit
