// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "tools/sample_mine/synthetic_world.hpp"

namespace adit {

/// A mine for long drives: nine by eight drifts that cross at right angles and leave 8 by 7 blocks
/// of 40 m by 30 m between their centre lines, 320 m by 210 m in all. The walls come from the seed.
SyntheticWorld tunnel_grid(std::uint64_t seed);

/// A way through any such grid that is at least so long: around each block, of which it has seen
/// some sides from the blocks before, then on to the next, row by row; after the last block from
/// the beginning again. It begins at the origin, a corner of the grid.
std::vector<Eigen::Vector2d> tunnel_grid_route(double length_min_m);

}  // namespace adit
