// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <vector>

#include "procs/planning/goal_field.hpp"
#include "procs/planning/lattice.hpp"

namespace adit {

/// Where a robot can get to, and how far towards the goal.
struct Reachable {
  std::vector<LatticePose> poses;  ///< in order of discovery
  double progress_m = 0.0;         ///< the greatest of those where a path may end, not less than 0
};

/// All that can be reached from a pose, at any cost, or as much as it takes to make a progress of
/// `enough_m`. Empty where the robot cannot stand.
Reachable reachable(const Lattice& lattice, const LatticePose& start, const GoalField& goals,
                    double enough_m = std::numeric_limits<double>::infinity());

}  // namespace adit
