// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "common/vehicle/vehicle.hpp"

namespace adit {

/// How the vehicle moves: speed and curvature as in DriveCommand.
struct ArcMotion {
  double speed_m_s = 0.0;
  double curvature_1_m = 0.0;
};

/// 1 forward, -1 in reverse, 0 where it stands.
inline int direction_of(const ArcMotion& motion) {
  return (motion.speed_m_s > 0.0 ? 1 : 0) - (motion.speed_m_s < 0.0 ? 1 : 0);
}

/// What the footprint covers while the vehicle drives on along a circle: exact, for points. The
/// body turns about the centre of the circle, which for a vehicle that steers by the front wheels
/// alone lies on the line of its rear axle, and so in its own frame a point goes round that centre
/// the other way, and meets the footprint where its circle crosses an edge.
class ArcSweep {
 public:
  /// `speed_m_s` must not be 0; of it only the sign counts. The curvature is clamped to what the
  /// vehicle can do. The footprint is wider by `side_margin_m` on either side, but for points that
  /// are nearer than that already: the vehicle may go on beside what it stands close to, as long as
  /// it does not touch it.
  ArcSweep(const Vehicle& vehicle, const ArcMotion& motion, double side_margin_m);

  /// Way of the body's origin [m] until the footprint meets the point (body frame); infinity where
  /// it does not within a turn. Points in the footprint count as met, at 0, where it drives towards
  /// them, and otherwise not at all: it may be driven out of what it stands in.
  [[nodiscard]] double way_m(const Eigen::Vector2d& p_body) const;

  /// Nothing farther from the body's origin than this is met within the way [m].
  [[nodiscard]] double reach_m(double way_m) const;

 private:
  struct Rectangle {
    double x_m;                 ///< half the length
    double y_m;                 ///< half the width
    double radius_min_m = 0.0;  ///< of the ring about the centre in which it lies
    double radius_max_m = 0.0;

    [[nodiscard]] bool holds(const Eigen::Vector2d& p_body) const;
  };

  [[nodiscard]] Rectangle rectangle(double x_m, double y_m) const;
  [[nodiscard]] double way_m(const Eigen::Vector2d& p_body, const Rectangle& footprint) const;
  [[nodiscard]] double straight_way_m(const Eigen::Vector2d& p_body,
                                      const Rectangle& footprint) const;
  [[nodiscard]] double turn_rad(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;

  double direction_;  ///< 1 forward, -1 in reverse
  double curvature_1_m_;
  bool straight_;
  Eigen::Vector2d centre_{0.0, 0.0};  ///< of the circle, in the body frame
  Rectangle bare_;
  Rectangle wide_;
};

}  // namespace adit
