// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "procs/exploration/drivable_space.hpp"

namespace adit {

/// The middle lines of what can be reached, one cell wide and connected as it is: parallel thinning
/// (Guo and Hall 1989). 1 where a cell is on one.
CellField<std::uint8_t> skeleton(const DrivableSpace& space);

}  // namespace adit
