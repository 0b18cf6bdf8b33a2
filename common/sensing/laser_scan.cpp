// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/sensing/laser_scan.hpp"

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

double ScanTiming::beam_time_s(int beam, double angle_step_rad) const {
  const int turn = beam % turns(angle_step_rad);
  return (turn + beam * angle_step_rad / (2.0 * std::numbers::pi)) / mirror_hz;
}

}  // namespace adit
