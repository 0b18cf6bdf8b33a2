// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/sensing/laser_mount.hpp"

namespace adit {

Eigen::Isometry3d tilted_laser(const LaserMount& mount, double tilt_rad) {
  const Pose2& level = mount.T_body_laser;
  const Eigen::Vector3d lever(mount.lever_x_m, 0.0, mount.lever_z_m);
  return Eigen::Translation3d(level.x, level.y, mount.height_m) *
         Eigen::AngleAxisd(level.theta, Eigen::Vector3d::UnitZ()) * Eigen::Translation3d(-lever) *
         Eigen::AngleAxisd(tilt_rad, Eigen::Vector3d::UnitY()) * Eigen::Translation3d(lever);
}

Eigen::Isometry3d T_body_lidar(const Lasers& lasers) {
  LaserMount mount = lasers.front;
  mount.lever_x_m = mount.lever_z_m = 0.0;
  return tilted_laser(mount, lasers.lidar.pitch_rad);
}

}  // namespace adit
