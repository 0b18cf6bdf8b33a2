// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/sweep/tilt_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/geometry/pose2.hpp"
#include "sim/laser/laser_model.hpp"
#include "sim/vehicle/stance.hpp"

namespace adit {
namespace {

double floor_m(const World& world, const Pose2& T_world_plan) {
  const auto height = world.truth.floor_height(T_world_plan.translation());
  if (!height) throw std::invalid_argument("there is no floor at the pose of the vehicle");
  return *height;
}

double tilt_rad(const TiltSweep& sweep, int scan) {
  return std::lerp(sweep.tilt_from_rad, sweep.tilt_to_rad,
                   static_cast<double>(scan) / std::max(sweep.scans - 1, 1));
}

CloudLine line(const LaserScan& scan, const LaserMount& mount,
               const Eigen::Isometry3d& T_level_laser) {
  CloudLine line;
  line.utime = scan.utime;
  line.origin = T_level_laser.translation().cast<float>();
  double angle_rad = scan.angle_min_rad;
  for (const float range_m : scan.ranges_m) {
    const Eigen::Vector3d beam =
        T_level_laser.linear() * Eigen::Vector3d(std::cos(angle_rad), std::sin(angle_rad), 0.0);
    angle_rad += scan.angle_step_rad;
    if (range_m < mount.range_min_m) continue;
    if (range_m >= mount.range_max_m) {
      line.misses.emplace_back(beam.cast<float>());
    } else {
      line.points.emplace_back((T_level_laser.translation() + range_m * beam).cast<float>());
    }
  }
  return line;
}

}  // namespace

Eigen::Isometry3d level_on_floor(const World& world, const Pose2& T_world_plan) {
  return in_space(T_world_plan, floor_m(world, T_world_plan));
}

Eigen::Isometry3d standing(const Site& site, const Pose2& T_world_plan, const Vehicle& vehicle) {
  Stance stance(site, vehicle);
  const auto fault = stance.put(T_world_plan, floor_m(site.world(), T_world_plan));
  if (fault) throw std::invalid_argument(*fault);
  return stance.T_world_body();
}

Cloud tilt_sweep(const Site& site, const Eigen::Isometry3d& T_world_body, const TiltSweep& sweep) {
  LaserModel laser(site.scene(), sweep.laser, sweep.seed);
  Cloud cloud;
  cloud.T_odom_level = in_plan(T_world_body);
  cloud.z_odom_m = T_world_body.translation().z();
  const Eigen::Isometry3d T_world_level = in_space(cloud.T_odom_level, cloud.z_odom_m);
  const double period_s = sweep.laser.timing.scan_period_s(sweep.laser.angle_step_rad());
  for (int scan = 0; scan < sweep.scans; ++scan) {
    const Eigen::Isometry3d T_world_laser =
        T_world_body * tilted_laser(sweep.mount, tilt_rad(sweep, scan));
    const auto utime = static_cast<std::int64_t>(std::llround(scan * period_s * 1e6));
    const LaserScan measured =
        laser.measure([&](double) { return Eigen::Isometry3d(T_world_laser); }, utime);
    cloud.lines.push_back(line(measured, sweep.mount, T_world_level.inverse() * T_world_laser));
  }
  cloud.utime = static_cast<std::int64_t>(std::llround(sweep.scans * period_s * 1e6));
  return cloud;
}

}  // namespace adit
