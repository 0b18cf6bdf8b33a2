// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "common/types/cloud.hpp"
#include "tools/ros/messages/ros_messages.hpp"

namespace adit {

/// A 3D scan without a sweep from points in the frame of a sensor [m], taken where the body has the
/// pose `T_odom_body`, of which the attitude makes the scan level. All points have the same time;
/// beams without a return are not known.
Cloud placed_cloud(const std::vector<Eigen::Vector3f>& points, std::int64_t utime,
                   const Eigen::Isometry3d& T_body_sensor, const Eigen::Isometry3d& T_odom_body);

/// Chooses 3D scans of a moving sensor by the distance between them.
class CloudSpacing {
 public:
  explicit CloudSpacing(double spacing_m) : spacing_m_(spacing_m) {}

  /// Whether the scan from here is wanted; the next one is as far from it.
  bool take(const Eigen::Vector3d& p_odom_body);

 private:
  double spacing_m_;
  std::optional<Eigen::Vector3d> last_;
};

}  // namespace adit
