// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/world/random/random_generator.hpp"
#include "sim/world/world_description.hpp"

namespace adit {

/// Length of the drift behind the entrance before anything leaves it or stands in it [m].
constexpr double kUndamagedLength = 24.0;

// Plans of about `length_m` of drifts, all widths 2.5 to 6 m. The first drift is `main`; it begins
// at the origin, along x, and is the entrance. What is too short for its topology is `main` alone.

/// Two or three drifts side by side, with crosscuts.
PlanDescription parallel_entries(double length_m, RandomGenerator& rng);
/// A panel of pillars behind one drift.
PlanDescription room_and_pillar(double length_m, RandomGenerator& rng);
/// A drift from which others leave to both sides, and others again from these.
PlanDescription branching(double length_m, RandomGenerator& rng);
/// A loop, and a drift across it.
PlanDescription ring(double length_m, RandomGenerator& rng);

}  // namespace adit
