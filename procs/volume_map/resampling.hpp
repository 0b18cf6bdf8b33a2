// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/geometry/pose2.hpp"
#include "procs/volume_map/cell_set.hpp"
#include "procs/volume_map/sub_volume.hpp"

namespace adit {

/// Adds the cells of map, of the same size, in which the cells of the sub-volume come to lie: of an
/// occupied one its middle, so that walls do not grow thicker; of a free one four points, so that
/// turned cells leave no holes in space that is free. What falls out of the grid is left out.
void resample(const SubVolume& volume, const Pose2& T_map_volume, CellSet& free, CellSet& occupied);

}  // namespace adit
