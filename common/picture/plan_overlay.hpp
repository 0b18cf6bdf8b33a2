// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/picture/map_panel.hpp"
#include "common/picture/plan_picture.hpp"

namespace adit {

/// The terrain in grey with the region that the robot reached laid over it, where there is no path.
RgbImage reached_image(const PlanPicture& picture);

/// Draws onto a terrain map: the goal, the path with the outline of the vehicle every metre, what
/// blocks it in the colour of the reason, and the robot.
void draw_plan(const MapPanel& panel, const PlanPicture& picture);
/// The middle of the vehicle along the path, and no more: for small maps.
void draw_way(const MapPanel& panel, const PlannedPath& path);

Legend plan_legend(const PlanPicture& picture);

}  // namespace adit
