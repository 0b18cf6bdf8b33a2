// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "tests/eval/merge/merge_truth.hpp"

namespace adit {

// Walks (test::walked_map) in undamaged, level mines of the generator of random mines, 100 m of
// tunnels.

/// Seed and topology of a mine.
std::string mine_name(int seed);

/// Ten walks of 60 m by two robots, which begin at three places.
std::vector<TrueRun> ten_runs(int seed);

/// One walk through all of the mine.
TrueRun whole_mine(int seed, int robot);
/// The same in a mine of the same plan, of which the walls have another relief.
TrueRun mine_with_other_walls(int seed);

/// A walk through a smooth straight tunnel of 60 m and a branch near its end, which is elsewhere in
/// another variant. All seeds and variants have the same tunnel.
TrueRun straight_tunnel_run(int seed, int variant);

}  // namespace adit
