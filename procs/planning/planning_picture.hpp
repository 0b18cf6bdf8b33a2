// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "common/picture/plan_picture.hpp"
#include "procs/planning/planning.hpp"

namespace adit {

/// What the last plan rested on, to be drawn: C-space maps at the headings of these angles in
/// level, and the kernels of some headings (the paper's figure 5c).
PlanPicture planning_picture(const std::string& title, const TerrainMap& terrain,
                             const PlannedPath& path, const Planning& planning,
                             const Vehicle& vehicle, const std::vector<double>& angles_rad);

}  // namespace adit
