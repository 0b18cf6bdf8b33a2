// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/guard/laser_monitor.hpp"

#include <cmath>
#include <limits>

#include <Eigen/Geometry>
#include <fmt/format.h>

namespace adit {
namespace {

const Eigen::Vector2d kNothing =
    Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());

bool is_return(double range_m, const LaserMount& mount) {
  return range_m >= mount.range_min_m && range_m < mount.range_max_m;  // false for NaN
}

bool is_at_obstacle_height(double height_m, const Vehicle& vehicle) {
  return height_m > vehicle.step_max_m && height_m < vehicle.height_m;
}

}  // namespace

LaserPoints project_scan(const LaserScan& scan, const LaserMount& mount, double tilt_rad,
                         const Eigen::Vector3d& up_body, const Vehicle& vehicle) {
  const Eigen::Isometry3d T_body_laser = tilted_laser(mount, tilt_rad);
  LaserPoints points;
  points.p_body.assign(scan.ranges_m.size(), kNothing);
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double range_m = scan.ranges_m[i];
    if (!is_return(range_m, mount)) continue;
    ++points.returns;
    const double bearing = scan.angle_min_rad + static_cast<double>(i) * scan.angle_step_rad;
    const Eigen::Vector3d p_laser(range_m * std::cos(bearing), range_m * std::sin(bearing), 0.0);
    const Eigen::Vector3d p = T_body_laser * p_laser;
    if (!is_at_obstacle_height(p.z(), vehicle) || !is_at_obstacle_height(up_body.dot(p), vehicle))
      continue;
    points.p_body[i] = p.head<2>();
  }
  return points;
}

void LaserMonitor::receive(const TiltReading& reading, std::int64_t at_us) {
  if (tilt_.receive(at_us)) tilt_rad_ = reading.angle_rad;
}

bool LaserMonitor::receive(const LaserScan& scan, std::int64_t at_us,
                           const Eigen::Vector3d& up_body, const Vehicle& vehicle) {
  if (!scan_.receive(at_us)) return false;
  points_ = project_scan(scan, mount_, tilt_rad_, up_body, vehicle);
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
