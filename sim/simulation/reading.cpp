// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/simulation/reading.hpp"

namespace adit {
namespace {

struct UtimeOf {
  std::int64_t& operator()(LaserReading& laser) const { return laser.scan.utime; }
  std::int64_t& operator()(LaserTiltReading& tilt) const { return tilt.reading.utime; }
  std::int64_t& operator()(auto& reading) const { return reading.utime; }
};

}  // namespace

std::int64_t& utime_of(Reading& reading) { return std::visit(UtimeOf{}, reading); }

bool is_driver_reading(const Reading& reading) {
  return !std::holds_alternative<BodyMotion>(reading) && !std::holds_alternative<RunState>(reading);
}

}  // namespace adit
