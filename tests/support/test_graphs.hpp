// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "common/pose_graph/pose_graph.hpp"

namespace adit::test {

/// A walk of `nodes` poses round and round a square of `side` metres, one metre a step, with
/// constraints from each pose to the next and to the one a round before. Measurements are noisy by
/// `noise` metres and a tenth of it in radians, their information full and different for each;
/// the poses are true. Two calls with the same arguments give the same graph.
PoseGraph square_walk(int nodes, int side, double noise, std::uint32_t seed = 1);

}  // namespace adit::test
