// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/geometry/motion3.hpp"

namespace adit {

Eigen::Matrix3d skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d S;
  S << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return S;
}

Vector6d motion_of(const Eigen::Isometry3d& T) {
  const Eigen::AngleAxisd turn(T.linear());
  Vector6d motion;
  motion << T.translation(), turn.angle() * turn.axis();
  return motion;
}

Eigen::Isometry3d isometry_of(const Vector6d& motion) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  const double angle = motion.tail<3>().norm();
  if (angle > 0.0) T.linear() = Eigen::AngleAxisd(angle, motion.tail<3>() / angle).matrix();
  T.translation() = motion.head<3>();
  return T;
}

}  // namespace adit
