// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "common/geometry/pose2.hpp"
#include "common/types/cloud.hpp"
#include "procs/volume_map/placed_volume.hpp"

namespace adit {

/// Selects the older scans that a new one replaces where a mine is traversed repeatedly: all those
/// from within `replace_radius_m` of it with the same heading. Replacing only the nearest one would
/// fill the mine up to the densest packing (random sequential adsorption), which takes arbitrarily
/// long, as the remaining gaps are hit ever more rarely. With this rule viewpoints are removed as
/// often as they are added, and their number settles after a few rounds: one per
/// 2 `replace_radius_m` of tunnel and heading.
///
/// Scans of one visit are an exception, otherwise each would replace the one before it and a drive
/// would leave nothing behind: a viewpoint that the robot has not departed from keeps its position,
/// and a scan farther from it than `replace_radius_m` makes another one.

/// Viewpoint and heading of a scan in level: its lasers are at the ends of the body and face
/// outwards.
[[nodiscard]] Pose2 viewpoint_of(const Cloud& cloud);

/// Both poses must be in the same frame.
[[nodiscard]] bool is_same_viewpoint(const Pose2& T_a, const Pose2& T_b, double replace_radius_m);

/// Marks the volumes farther than `replace_radius_m` from the new viewpoint as departed.
void mark_departed(std::vector<PlacedVolume>& volumes, const Pose2& T_map_viewpoint,
                   double replace_radius_m);

/// Indices of the volumes to replace: first the one of this visit, the nearest if there are
/// several, then all departed ones.
[[nodiscard]] std::vector<std::size_t> volumes_to_replace(const std::vector<PlacedVolume>& volumes,
                                                          const Pose2& T_map_viewpoint,
                                                          double replace_radius_m);

}  // namespace adit
