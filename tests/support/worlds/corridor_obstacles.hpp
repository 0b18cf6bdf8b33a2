// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/world/random/random_generator.hpp"
#include "tests/support/worlds/random_corridor.hpp"

namespace adit {

/// What the kind of a mine says, ahead of its robot, and some rails, posts and stones.
void add_obstacles(RandomCorridorMine& mine, RandomGenerator& rng);

}  // namespace adit
