// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "tools/mission/mission_folder.hpp"
#include "tools/mission/mission_live.hpp"

namespace adit {

/// Writes into the folder what all processes of a mission read. One that goes on keeps its
/// configuration, and the simulated robot stands where TRUTH last had it. Returns where it once
/// began, in world [m]. Throws for options that cannot be used, and as MissionFolder does.
Eigen::Vector2d prepare_mission(const MissionLiveOptions& options, const MissionFolder& folder);

}  // namespace adit
