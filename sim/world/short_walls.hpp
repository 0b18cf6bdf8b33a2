// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/world/plan_mesh.hpp"

namespace adit {

/// Makes one point of neighbours on a wall that are nearer than `shortest_m`, half-way between
/// them: what stands on so short a piece of wall would be a strip that faces anywhere. A wall keeps
/// at least three points.
void join_short_walls(PlanMesh& mesh, double shortest_m);

}  // namespace adit
