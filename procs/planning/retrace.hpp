// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/geometry/pose2.hpp"
#include "common/path/planned_path.hpp"

namespace adit {

/// A path back on the track of the body, where no scan shows one: that it came there is proof
/// enough, and the guard watches. `goal.route_odom` is the track from the body back. The heading of
/// the body on it is that along the track, or its opposite, whichever the body has now; the path
/// ends where the track turns back on itself. Without half a metre of track there is none.
PlannedPath retrace(const PlanGoal& goal, const Pose2& T_odom_body);

}  // namespace adit
