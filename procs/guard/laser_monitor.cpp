// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/guard/laser_monitor.hpp"

#include <fmt/format.h>

namespace adit {

void LaserMonitor::receive(const TiltReading& reading, std::int64_t at_us) {
  if (tilt_.receive(at_us)) tilt_rad_ = reading.angle_rad;
}

bool LaserMonitor::receive(const LaserScan& scan, std::int64_t at_us,
                           const Eigen::Vector3d& up_body, const Vehicle& vehicle) {
  if (!scan_.receive(at_us)) return false;
  points_ = project_scan(scan, mount_, tilt_rad_, up_body,
                         {.min_m = vehicle.step_max_m, .max_m = vehicle.height_m});
  return true;
}

std::optional<std::string> LaserMonitor::fault(std::int64_t now_us, double timeout_s) const {
  if (auto stale = scan_.staleness(name_.c_str(), now_us, timeout_s)) return stale;
  if (points_.returns < kReturnsMin) {
    return fmt::format("{} blind, {} of {} beams return", name_, points_.returns,
                       points_.p_body.size());
  }
  return tilt_.staleness_if_received(("tilt of " + name_).c_str(), now_us, timeout_s);
}

}  // namespace adit
