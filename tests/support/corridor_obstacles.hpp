// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/world/random/dice.hpp"
#include "tests/support/corridor_mine.hpp"

namespace adit {

/// What the kind of a mine says, ahead of its robot, and some rails, posts and stones.
void add_obstacles(CorridorMine& mine, Dice& dice);

}  // namespace adit
