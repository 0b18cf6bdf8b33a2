// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "common/geometry/pose2.hpp"
#include "common/sensing/laser_mount.hpp"
#include "common/sensing/spinning_lidar.hpp"
#include "common/types/cloud.hpp"
#include "procs/scan_assembly/beam_placement.hpp"
#include "procs/scan_assembly/mixed_pixels.hpp"

namespace adit {

/// Transforms the rings of a revolution to the frame level, each column by the pose of the lidar at
/// its own time: a line for each ring.
class RingPlacement {
 public:
  /// The buffer must not be empty and must outlive this object. `R_level_body` levels the body at
  /// all its poses.
  RingPlacement(const Lasers& lasers, const InterpolationBuffer<Pose2>& T_odom_body,
                const Pose2& T_odom_level, const Eigen::Matrix3d& R_level_body)
      : T_body_lidar_(T_body_lidar(lasers)),
        T_odom_body_(T_odom_body),
        T_odom_level_(T_odom_level),
        R_level_body_(R_level_body) {}

  /// `image` has the ranges of the revolution, a row for each ring.
  [[nodiscard]] std::vector<CloudLine> place(const LidarRevolution& revolution,
                                             const RangeImage& image) const;

 private:
  [[nodiscard]] Eigen::Isometry3d T_level_lidar(std::int64_t utime) const;

  Eigen::Isometry3d T_body_lidar_;
  const InterpolationBuffer<Pose2>& T_odom_body_;
  Pose2 T_odom_level_;
  Eigen::Matrix3d R_level_body_;
};

}  // namespace adit
