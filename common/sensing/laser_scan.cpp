// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/sensing/laser_scan.hpp"

#include <algorithm>
#include <numbers>

namespace adit {
namespace {

constexpr double kTwoTurnsBelow = 0.75 * std::numbers::pi / 180.0;

}  // namespace

int ScanTiming::turns(double angle_step_rad) const {
  if (mirror_turns > 0) return mirror_turns;
  return angle_step_rad < kTwoTurnsBelow ? 2 : 1;
}

double ScanTiming::scan_period_s(double angle_step_rad) const {
  return turns(angle_step_rad) / mirror_hz;
}

double ScanTiming::beam_time_s(int beam, int beams, double angle_step_rad) const {
  const int order = clockwise ? beams - 1 - beam : beam;
  const int turn = order % turns(angle_step_rad);
  return (turn + order * angle_step_rad / (2.0 * std::numbers::pi)) / mirror_hz;
}

/// Where a scan takes several turns, one of as many beams at its end is the last.
double ScanTiming::last_beam_time_s(int beams, double angle_step_rad) const {
  double last_s = 0.0;
  for (int order = std::max(0, beams - turns(angle_step_rad)); order < beams; ++order) {
    const int beam = clockwise ? beams - 1 - order : order;
    last_s = std::max(last_s, beam_time_s(beam, beams, angle_step_rad));
  }
  return last_s;
}

}  // namespace adit
