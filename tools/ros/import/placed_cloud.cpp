// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/ros/import/placed_cloud.hpp"

#include <algorithm>
#include <cstddef>

#include "common/geometry/pose2.hpp"

namespace adit {
namespace {

constexpr std::size_t kLinePoints = 4000;  // so that a line fits a fragment (kFragmentBytes)

}  // namespace

Cloud placed_cloud(const std::vector<Eigen::Vector3f>& points, std::int64_t utime,
                   const Eigen::Isometry3d& T_body_sensor, const Eigen::Isometry3d& T_odom_body) {
  Cloud cloud;
  cloud.utime = utime;
  cloud.T_odom_level = in_plan(T_odom_body);
  cloud.z_odom_m = T_odom_body.translation().z();
  const Eigen::Isometry3d T_odom_level = in_space(cloud.T_odom_level, cloud.z_odom_m);
  const Eigen::Isometry3f T_level_sensor =
      (T_odom_level.inverse() * T_odom_body * T_body_sensor).cast<float>();
  for (std::size_t from = 0; from < points.size(); from += kLinePoints) {
    CloudLine line{utime, T_level_sensor.translation(), {}, {}};
    const std::size_t to = std::min(points.size(), from + kLinePoints);
    for (std::size_t i = from; i < to; ++i) line.points.push_back(T_level_sensor * points[i]);
    cloud.lines.push_back(std::move(line));
  }
  return cloud;
}

bool CloudSpacing::take(const Eigen::Vector3d& p_odom_body) {
  if (last_ && (p_odom_body - *last_).norm() < spacing_m_) return false;
  last_ = p_odom_body;
  return true;
}

}  // namespace adit
