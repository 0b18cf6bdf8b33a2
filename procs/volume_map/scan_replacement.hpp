// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "common/geometry/pose2.hpp"
#include "common/types/cloud.hpp"
#include "procs/volume_map/placed_volume.hpp"

namespace adit {

/// Which older looks a new one takes the place of, where a mine is gone through again and again:
/// all that are from within `replace_radius_m` of it and look the same way. To replace the nearest
/// alone would fill the mine up to the closest packing (random sequential adsorption), which takes
/// for ever, as the gaps that are left are ever rarer met. As it is, a place is given up as often
/// as it is taken, and a few rounds say how many there are: 1 in 2 `replace_radius_m` of a drift,
/// for each way to look.
///
/// Looks of one visit are an exception, or each would take away the one before it and a drive leave
/// nothing behind: the place of one that the robot has not left since stays where it is, and what
/// is farther from it than `replace_radius_m` is another.

/// Where a scan looks from, and which way, in level: its lasers sit at the ends of the body and
/// look away.
[[nodiscard]] Pose2 viewpoint_of(const Cloud& cloud);

/// Both in one frame.
[[nodiscard]] bool is_same_viewpoint(const Pose2& T_a, const Pose2& T_b, double replace_radius_m);

/// Takes note that there is a look from elsewhere, for those from farther away than
/// `replace_radius_m`.
void mark_departed(std::vector<PlacedVolume>& volumes, const Pose2& T_map_viewpoint,
                   double replace_radius_m);

/// Indices: first that of this visit, the nearest if there are several, then all that were left.
[[nodiscard]] std::vector<std::size_t> volumes_to_replace(const std::vector<PlacedVolume>& volumes,
                                                          const Pose2& T_map_viewpoint,
                                                          double replace_radius_m);

}  // namespace adit
