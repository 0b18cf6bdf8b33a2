// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/robot_that_matches_scans.hpp"

#include <cmath>
#include <utility>

#include "tests/support/groundhog_params.hpp"

namespace adit {

RobotThatMatchesScans::RobotThatMatchesScans(World world)
    : site_(std::move(world)), scan_matching_(bus_, with_groundhog_lasers<ScanMatchingParams>()) {}

void RobotThatMatchesScans::run(double seconds) {
  const std::int64_t end = sim_.simulation().utime() + std::llround(seconds * 1e6);
  while (sim_.simulation().utime() < end) {
    bus_.advance_to(sim_.next_utime());
    sim_.step();
  }
}

}  // namespace adit
