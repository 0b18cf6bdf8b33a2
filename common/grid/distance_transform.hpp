// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "common/grid/grid2.hpp"

namespace adit {

/// Distance from the centre of each cell to the centre of the nearest marked cell [m], exact;
/// infinite if no cell is marked (Felzenszwalb and Huttenlocher, "Distance transforms of sampled
/// functions", 2012). `marked` is not zero where marked.
Grid2<float> distance_transform(const Grid2<std::uint8_t>& marked, double cell_m);

}  // namespace adit
