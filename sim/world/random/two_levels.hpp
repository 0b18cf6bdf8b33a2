// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/world/world_description.hpp"

namespace adit {

/// A random mine of two levels: the same seed gives the same description. `main` leads from the
/// entrance along x on the upper level (0). Behind its end, a ramp (`ramp_top` on level 0, `ramp`
/// on level 1, `ramp_foot` on level 2) turns by 270 degrees, passes below its own beginning, and
/// reaches the lower level (2), whose tunnels run below those of the upper one, with at least 2 m
/// of rock between floor and roof. About 350 m of tunnels, 4.5 to 6.6 m between the levels, grades
/// of the ramp up to 28 %.
WorldDescription two_levels(int seed);

}  // namespace adit
