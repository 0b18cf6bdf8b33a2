// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/guard/laser_watch.hpp"

namespace adit {

void LaserWatch::hear(const TiltReading& reading, std::int64_t at_us) {
  if (tilt_.hear(at_us)) tilt_rad_ = reading.angle_rad;
}

bool LaserWatch::hear(const LaserScan& scan, std::int64_t at_us, const Eigen::Vector3d& up_body,
                      const Vehicle& vehicle) {
  if (!scan_.hear(at_us)) return false;
  points_ = place_scan(scan, mount_, tilt_rad_, up_body, vehicle);
  return true;
}

std::optional<std::string> LaserWatch::fault(std::int64_t now_us, double timeout_s) const {
  if (auto silent = scan_.silence(name_.c_str(), now_us, timeout_s)) return silent;
  if (points_.returns < kReturnsMin) {
    return name_ + " blind, " + std::to_string(points_.returns) + " of " +
           std::to_string(points_.p_body.size()) + " beams return";
  }
  return tilt_.silence_once_heard(("tilt of " + name_).c_str(), now_us, timeout_s);
}

}  // namespace adit
