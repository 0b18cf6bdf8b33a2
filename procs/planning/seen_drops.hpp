// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/terrain/terrain_map.hpp"

namespace adit {

/// The terrain without the drops that nobody saw to be any. Beams that pass over a place without
/// meeting it say that its ground is lower than they are. That is so of a pit, but behind a rail,
/// too, and where even ground gave nothing back. A hollow is a drop once beams were lower in it
/// than its rim, by the upper quartile, by more than `step_max_m`, which a wheel climbs; before, it
/// was never seen.
TerrainMap with_seen_drops(TerrainMap terrain, double step_max_m);

}  // namespace adit
