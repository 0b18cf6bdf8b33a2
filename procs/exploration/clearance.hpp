// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "procs/exploration/cell_field.hpp"
#include "procs/exploration/known_space.hpp"

namespace adit {

/// Distance from the middle of each cell to that of the nearest wall [m], exact in two
/// passes; 0 for what is wall or not seen; at most `largest_m`.
CellField<float> wall_clearance(const CellField<Known>& known, double resolution_m,
                                double largest_m);

}  // namespace adit
