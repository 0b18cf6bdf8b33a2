// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "common/picture/plan_picture.hpp"
#include "procs/planning/planning.hpp"

namespace adit {

/// The maps of the last plan as a picture: the C-space at the headings nearest to `angles_rad` in
/// level, and the kernels of some headings (figure 5c of the paper).
PlanPicture planning_picture(const std::string& title, const TerrainMap& terrain,
                             const PlannedPath& path, const Planning& planning,
                             const Vehicle& vehicle, const std::vector<double>& angles_rad);

}  // namespace adit
