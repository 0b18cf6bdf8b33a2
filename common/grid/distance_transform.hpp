// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace adit {

/// Distance from the centre of each cell to the centre of the nearest marked cell [m], exact;
/// infinite if no cell is marked (Felzenszwalb and Huttenlocher, "Distance transforms of sampled
/// functions", 2012). `marked`: row by row, `columns` cells per row, non-zero where marked.
std::vector<float> distance_transform(const std::vector<std::uint8_t>& marked, int columns,
                                      double cell_m);

}  // namespace adit
