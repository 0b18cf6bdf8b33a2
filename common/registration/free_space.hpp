// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"
#include "common/registration/surface_points.hpp"
#include "common/sensing/laser_mount.hpp"
#include "common/sensing/laser_scan.hpp"

namespace adit {

/// The region that one scan saw to be empty, to be held against the points of another: two scans
/// of the same place contradict each other where a point of one lies in the free space of the
/// other. No return says nothing: it may be water.
class FreeSpace {
 public:
  FreeSpace() = default;
  FreeSpace(const LaserScan& scan, const LaserMount& mount);

  /// How many of the points, moved by `T_body_points` into this scan's body frame, lie nearer than
  /// what was measured in their direction by more than `margin` [m].
  [[nodiscard]] int count_inside(const std::vector<SurfacePoint>& points,
                                 const Pose2& T_body_points, double margin) const;

  /// The same for one point in the frame of the laser.
  [[nodiscard]] bool inside(const Eigen::Vector2d& p_laser, double margin) const;
  /// T_laser_body.
  [[nodiscard]] const Pose2& body_in_laser() const { return T_laser_body_; }

 private:
  Pose2 T_laser_body_;
  double angle_min_ = 0.0;
  double angle_step_ = 1.0;
  std::vector<float> free_m_;  ///< by beam: nearest of the reading and its neighbours; 0: unknown
};

}  // namespace adit
