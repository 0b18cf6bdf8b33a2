// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/geometry/pose2.hpp"
#include "common/picture/canvas.hpp"
#include "sim/view/plan_view.hpp"
#include "sim/world/world.hpp"

namespace adit {

/// Draws over a window of the plan, whose upper left corner is at `corner` on the sheet, what has
/// no surface: gas, the start and the camera.
void draw_plan_marks(const Canvas& canvas, const PlanWindow& window, const Eigen::Vector2i& corner,
                     const World& world, const Pose2& T_world_camera);

}  // namespace adit
