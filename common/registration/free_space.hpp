// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tuple>
#include <vector>

#include <Eigen/Core>

#include "common/geometry/attitude.hpp"
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
  /// `z_m`: height of the origin of the body frame, in the frame of the heights of the points.
  FreeSpace(const LaserScan& scan, const LaserMount& mount, const Attitude& attitude = {},
            double z_m = 0.0);

  /// Number of points, transformed by `T_body_points` into the level frame of the body of this
  /// scan, that are nearer than the range measured in their direction by more than `margin` [m],
  /// and that the beam did not pass above or below.
  [[nodiscard]] int count_inside(const std::vector<SurfacePoint>& points,
                                 const Pose2& T_body_points, double margin) const;

  /// The same for one point, in the level frame of the laser.
  [[nodiscard]] bool inside(const Eigen::Vector2d& p_laser, double z_m, double margin) const;
  /// The same space, this much higher.
  [[nodiscard]] FreeSpace raised(double dz_m) const {
    FreeSpace raised = *this;
    raised.z_laser_m_ += dz_m;
    return raised;
  }
  /// T_laser_body, in plan.
  [[nodiscard]] const Pose2& body_in_laser() const { return T_laser_body_; }

  /// All there is of it, to be stored and restored.
  [[nodiscard]] auto fields() {
    return std::tie(T_laser_body_, angle_min_, angle_step_, z_laser_m_, rise_.x(), rise_.y(),
                    free_m_, reach_m_);
  }
  [[nodiscard]] auto fields() const {
    return std::tie(T_laser_body_, angle_min_, angle_step_, z_laser_m_, rise_.x(), rise_.y(),
                    free_m_, reach_m_);
  }

 private:
  Pose2 T_laser_body_;
  double angle_min_ = 0.0;
  double angle_step_ = 1.0;
  double z_laser_m_ = 0.0;
  Eigen::Vector2d rise_{0.0, 0.0};  ///< of the plane of the scan, along x and y of the level laser
  std::vector<float> free_m_;  ///< by beam: minimum of the reading and its neighbours; 0: unknown
  float reach_m_ = 0.0F;       ///< maximum of these
};

}  // namespace adit
