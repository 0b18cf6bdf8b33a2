// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/world/random/random_generator.hpp"
#include "tests/support/worlds/random_corridor.hpp"

namespace adit {

/// Adds the obstacles of `mine.kind` ahead of the robot, and random rails, posts, rubble, mud and
/// side tunnels.
void add_obstacles(RandomCorridorMine& mine, RandomGenerator& rng);

}  // namespace adit
