// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "procs/terrain/memory/height_plane.hpp"
#include "procs/terrain/memory/remembered_map.hpp"
#include "procs/terrain/terrain_params.hpp"

namespace adit {

/// Aligns the heights of an earlier scan to the new one, from the ground that both observed and the
/// ground on which the body stood. The correction is a plane over the level of the new scan, since
/// each level has its origin on the ground where it was taken, and gravity is known to about a
/// degree. Empty if they have too little in common, unless they are from
/// the same place, or if their heights or obstacles differ too much: then a level or odom is wrong.
std::optional<HeightPlane> align_heights(const TerrainMap& now, const RememberedMap& before,
                                         const TerrainParams& params);

}  // namespace adit
