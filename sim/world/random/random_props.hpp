// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/world/random/random_generator.hpp"
#include "sim/world/world_description.hpp"

namespace adit {

/// Generates the props along all tunnels except the first metres behind the entrance: damage at the
/// fraction `damage` of the places, and intact posts between them.
PropDescriptions random_props(const PlanDescription& plan, double damage, RandomGenerator& rng);

}  // namespace adit
