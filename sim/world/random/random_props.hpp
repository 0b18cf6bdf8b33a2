// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/world/random/random_generator.hpp"
#include "sim/world/world_description.hpp"

namespace adit {

/// What stands, lies and gapes along all drifts but for the first metres behind the entrance:
/// damage at the share of places that `damage` says, and whole posts between.
PropDescriptions random_props(const PlanDescription& plan, double damage, RandomGenerator& rng);

}  // namespace adit
