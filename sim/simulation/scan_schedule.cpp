// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/simulation/scan_schedule.hpp"

#include <algorithm>
#include <cmath>

namespace adit {

ScanSchedule::ScanSchedule(const LaserParams& params, std::int64_t start_utime, double phase)
    : start_utime_(start_utime),
      phase_(phase),
      period_s_(params.timing.scan_period_s(params.angle_step_rad())),
      last_beam_s_(0.0),
      keep_every_(params.keep_every) {
  for (const int beam : {params.beams - 2, params.beams - 1}) {  // of two turns each has a last one
    last_beam_s_ = std::max(last_beam_s_, params.timing.beam_time_s(beam, params.angle_step_rad()));
  }
}

std::int64_t ScanSchedule::begin_utime() const {
  const double seconds = (phase_ + static_cast<double>(scan_)) * period_s_;
  return start_utime_ + std::llround(seconds * 1e6);
}

std::int64_t ScanSchedule::end_utime() const {
  return begin_utime() + static_cast<std::int64_t>(std::ceil(last_beam_s_ * 1e6));
}

}  // namespace adit
