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

/// The free space observed by one scan, to test against the points of another: two scans of the
/// same place contradict each other where a point of one lies in the free space of the other. A
/// beam without return observes no free space: it may have met water.
class FreeSpace {
 public:
  FreeSpace() = default;
  FreeSpace(const LaserScan& scan, const LaserMount& mount);

  /// Number of points, transformed by `T_body_points` into the body frame of this scan, that are
  /// nearer than the range measured in their direction by more than `margin` [m].
  [[nodiscard]] int count_inside(const std::vector<SurfacePoint>& points,
                                 const Pose2& T_body_points, double margin) const;

  /// The same for one point in the laser frame.
  [[nodiscard]] bool inside(const Eigen::Vector2d& p_laser, double margin) const;
  /// T_laser_body.
  [[nodiscard]] const Pose2& body_in_laser() const { return T_laser_body_; }

 private:
  Pose2 T_laser_body_;
  double angle_min_ = 0.0;
  double angle_step_ = 1.0;
  std::vector<float> free_m_;  ///< by beam: minimum of the reading and its neighbours; 0: unknown
};

}  // namespace adit
