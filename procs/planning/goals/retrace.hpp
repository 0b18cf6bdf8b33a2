// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/geometry/pose2.hpp"
#include "common/types/planned_path.hpp"

namespace adit {

/// A path back over the poses that the body had, where no scan shows one: that it came that way is
/// proof enough, and the guard watches. Where it turned, it turns again. `goal.traversed_path_odom`
/// are the poses from the body back; the path is no longer than `goal.distance_m`, and ends at a
/// gap of the track. Without half a metre of track there is none.
PlannedPath retrace(const PlanGoal& goal, const Pose2& T_odom_body);

/// How far from a pose of the track another may be for it to go on from there: a pose of the
/// lattice that stands for it is no farther.
inline constexpr double kOnPathM = 0.1;
inline constexpr double kOnPathRad = 0.1;

/// Goes on along the track, as `retrace` does, from the end of a path that leads to it: from the
/// last of the poses that it is on.
void append_traversed_path(PlannedPath& path, const PlanGoal& goal);

}  // namespace adit
