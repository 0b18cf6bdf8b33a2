// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "common/vehicle/vehicle.hpp"

namespace adit {

/// Squares of a PassableRaster under a vehicle, by column and row, counted from the lowest square
/// of the cell in which its middle is.
using Footprint = std::vector<std::array<int, 2>>;

/// The ways to stand in a cell with about one heading, the middle of all first: off by a third of
/// the cell or of the step between headings to either side.
std::vector<Footprint> footprints(const Vehicle& vehicle, double heading_rad, double cell_m);

}  // namespace adit
