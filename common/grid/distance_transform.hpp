// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace adit {

/// From the middle of each cell to that of the nearest one that is marked [m], exact; infinite
/// where none is. P. Felzenszwalb and D. Huttenlocher, Distance transforms of sampled functions,
/// 2012.
std::vector<float> distance_transform(const std::vector<std::uint8_t>& marked, int columns,
                                      double cell_m);

}  // namespace adit
