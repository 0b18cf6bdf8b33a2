// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "common/mission/mission_phase.hpp"

namespace adit {

/// How a mission stands, for a line of progress.
struct MissionProgress {
  MissionPhase phase;
  double simulated_s = 0.0;
  double from_start_m = 0.0;  ///< of the true body, straight
  int local_maps = 0;
};

/// One line; `factor` is how many times real time it goes.
std::string progress_text(const MissionProgress& progress, double factor);

}  // namespace adit
