// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/world/random/random_generator.hpp"
#include "sim/world/world_description.hpp"

namespace adit {

/// Steepest grade that random mines have without being too steep on purpose: what the vehicle
/// climbs.
constexpr double kRandomGradeMax = 0.30;
/// Least grade of a stretch that is too steep on purpose: beyond the slope that planning accepts
/// (0.35 rad).
constexpr double kTooSteepMin = 0.42;

/// Makes a level mine uneven: the seam dips and rolls, its grade changes smoothly or at once, the
/// ground is smooth or rough, and tunnels have ramps, humps and sills of their own between their
/// junctions. The plan stays as it is, and so do the first metres behind the entrance. Objects on
/// ramps, humps and sills are removed, and water and cars from slopes on which they could not be.
void add_relief(WorldDescription& mine, RandomGenerator& rng);

}  // namespace adit
