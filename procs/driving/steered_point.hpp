// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/geometry/pose2.hpp"
#include "common/vehicle/vehicle.hpp"

namespace adit {

/// The point of the body that moves along the body's x axis: the origin with four-wheel steering
/// (both axles alike, to opposite sides), the middle of the rear axle with Ackermann steering. It
/// moves as a unicycle does, and so what is steered is always this point.
class SteeredPoint {
 public:
  /// Throws std::invalid_argument for Ackermann steering with a turning radius of the origin of
  /// half the wheelbase or less, which has no such path.
  explicit SteeredPoint(const Vehicle& vehicle);

  /// The same heading, at the point.
  [[nodiscard]] Pose2 pose(const Pose2& T_odom_body) const;
  /// Greatest of the path of the point [1/m].
  [[nodiscard]] double curvature_max_1_m() const { return curvature_max_1_m_; }
  /// Of the path of the body's origin, as commands have it, where that of the point is given.
  [[nodiscard]] double curvature_of_origin(double curvature_1_m) const;

 private:
  double x_m_ = 0.0;  ///< in the body frame
  double curvature_max_1_m_;
};

}  // namespace adit
