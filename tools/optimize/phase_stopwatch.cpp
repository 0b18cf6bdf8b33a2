// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/optimize/phase_stopwatch.hpp"

#include <numeric>

namespace adit {

double PhaseStopwatch::total_ms() const {
  return std::accumulate(ms_.begin(), ms_.begin() + index(OptimizePhase::kEnd), 0.0);
}

void PhaseStopwatch::enter(OptimizePhase begins) {
  const Clock::time_point now = Clock::now();
  ms_[index(phase_)] += std::chrono::duration<double, std::milli>(now - since_).count();
  phase_ = begins;
  since_ = now;
}

}  // namespace adit
