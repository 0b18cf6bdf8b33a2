// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/scan_assembly/beam_placement.hpp"

#include <algorithm>
#include <cmath>

#include "common/geometry/pose2.hpp"

namespace adit {

CloudLine BeamPlacement::place(const LaserScan& scan, const std::vector<float>& ranges_m) const {
  CloudLine line;
  line.utime = scan.utime;
  const std::int64_t mean_utime = scan.utime + (end_utime(scan) - scan.utime) / 2;
  line.origin = T_level_laser(mean_utime).translation().cast<float>();
  for (std::size_t i = 0; i < ranges_m.size(); ++i) {
    if (std::isnan(ranges_m[i])) continue;
    const auto beam = static_cast<int>(i);
    const double bearing = scan.angle_min_rad + beam * scan.angle_step_rad;
    const Eigen::Vector3d direction(std::cos(bearing), std::sin(bearing), 0.0);
    const Eigen::Isometry3d T = T_level_laser(utime_of_beam(scan, beam));
    if (std::isinf(ranges_m[i])) {
      line.misses.push_back((T.linear() * direction).cast<float>());
    } else {
      line.points.push_back((T * (double{ranges_m[i]} * direction)).cast<float>());
    }
  }
  return line;
}

std::int64_t BeamPlacement::utime_of_beam(const LaserScan& scan, int beam) const {
  const auto beams = static_cast<int>(scan.ranges_m.size());
  return scan.utime + std::llround(1e6 * timing_.beam_time_s(beam, beams, scan.angle_step_rad));
}

std::int64_t BeamPlacement::end_utime(const LaserScan& scan) const {
  const auto beams = static_cast<int>(scan.ranges_m.size());
  return scan.utime + std::llround(1e6 * timing_.last_beam_time_s(beams, scan.angle_step_rad));
}

Eigen::Isometry3d BeamPlacement::T_level_laser(std::int64_t utime) const {
  const Pose2 T_odom_body = motion_.T_odom_body.at(utime).value();
  Eigen::Isometry3d T_level_body = in_space(between(motion_.T_odom_level, T_odom_body));
  T_level_body.rotate(motion_.R_level_body);
  return T_level_body * tilted_laser(mount_, motion_.tilt_rad.at(utime).value());
}

}  // namespace adit
