// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/config/bounds.hpp"
#include "common/geometry/convex_polygon.hpp"
#include "common/sensing/obstacle_points.hpp"
#include "common/types/vehicle.hpp"

namespace adit {

/// Motion along an arc: speed and curvature as in DriveCommand.
struct ArcMotion {
  double speed_m_s = 0.0;
  double curvature_1_m = 0.0;
};

/// 1 forward, -1 in reverse, 0 at standstill.
inline int direction_of(const ArcMotion& motion) {
  return (motion.speed_m_s > 0.0 ? 1 : 0) - (motion.speed_m_s < 0.0 ? 1 : 0);
}

/// Exact collision check of the footprint along a circle, for points. The body rotates about the
/// centre of the circle, which lies on the line of the rear axle with Ackermann steering. In the
/// body frame a point moves around that centre in the opposite direction, and meets the footprint
/// where its circle crosses an edge.
class ArcSweep {
 public:
  /// `speed_m_s` must not be 0; only its sign counts. The curvature is clamped to that of the
  /// vehicle. The footprint is widened by `side_margin_m` on either side, except for points that
  /// are already within the margin: the vehicle may drive on beside a close obstacle, but not turn
  /// towards it, as side slip and errors of ranges take the rest of the margin.
  ArcSweep(const Vehicle& vehicle, const ArcMotion& motion, double side_margin_m);

  /// Distance of the body's origin [m] until the footprint meets the point (body frame); infinity
  /// if it does not within a full turn. For points inside the footprint the distance is 0 if the
  /// vehicle drives towards them, and infinite otherwise: it may drive away from them.
  [[nodiscard]] double distance_m(const Eigen::Vector2d& p_body) const;

  /// Points farther from the body's origin than this are not met within a distance [m].
  [[nodiscard]] double reach_m(double distance_m) const;

 private:
  struct Footprint {
    ConvexPolygon outline{{}};
    double radius_min_m = 0.0;  ///< of the ring around the centre of the circle
    double radius_max_m = 0.0;
  };

  [[nodiscard]] bool turns_towards(const Eigen::Vector2d& p_body) const;
  [[nodiscard]] Footprint ringed(const ConvexPolygon& outline) const;
  [[nodiscard]] double distance_m(const Eigen::Vector2d& p_body, const Footprint& footprint) const;
  [[nodiscard]] double straight_distance_m(const Eigen::Vector2d& p_body,
                                           const Footprint& footprint) const;
  [[nodiscard]] double turn_rad(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;

  double direction_;  ///< 1 forward, -1 in reverse
  double curvature_1_m_;
  bool straight_;
  Eigen::Vector2d centre_{0.0, 0.0};  ///< of the circle, in the body frame
  Footprint footprint_;
  Footprint widened_footprint_;
};

struct ObstacleParams {
  double reaction_s = 0.1;    ///< from a scan to the brakes
  double braking_m_s2 = 0.6;  ///< guaranteed by the vehicle
  double margin_m = 0.15;     ///< remaining distance; larger than the blind range
  /// The same for what only the side margin meets, such as a wall beside the path while the vehicle
  /// steers.
  double flank_margin_m = 0.05;
  double side_margin_m = 0.05;      ///< beside the footprint, from 0.25 m/s on
  double side_margin_s = 0.2;       ///< the same for each m/s, below that
  double side_margin_min_m = 0.01;  ///< three standard deviations of the mean of three ranges
  double release_margin_m = 0.03;   ///< free beyond the stopping distance before a release

  template <class V>
  void visit(V& v) {
    v("reaction_s", reaction_s, within(0.0, 5.0));
    v("braking_m_s2", braking_m_s2, above(0.0));
    v("margin_m", margin_m, at_least(0.0));
    v("flank_margin_m", flank_margin_m, at_least(0.0));
    v("side_margin_m", side_margin_m, at_least(0.0));
    v("side_margin_s", side_margin_s, at_least(0.0));
    v("side_margin_min_m", side_margin_min_m, at_least(0.0));
    v("release_margin_m", release_margin_m, within(0.0, 1.0));
  }
};

/// Stopping distance without a margin [m], on data of the age `age_s`.
double stopping_distance_m(const ObstacleParams& params, double speed_m_s, double age_s);

/// Margin beside the footprint [m]. The vehicle leaves an arc the less the shorter it takes to
/// stop: slowly it may pass where walls are near. Driving reduces its speed to 3.3 /s times the
/// clearance (driving.speed), which leaves a third of it beyond this margin.
double side_margin_m(const ObstacleParams& params, double speed_m_s);

/// Distance of the body's origin to the first obstacle [m]; infinity if none is nearer than
/// `within_m`. Two neighbouring beams must hit it: a single one may be a mixed pixel, dust or a
/// drop of water. At half a degree, two beams hit a post of 4 cm up to 2 m away, and a cable of 1
/// cm up to 0.5 m: this is less than the stopping distance above about 0.6 m/s, so that cables are
/// usually, but not certainly, detected in time at the speed of this vehicle.
double distance_to_obstacle_m(const LaserPoints& points, const ArcSweep& sweep, double within_m);

/// The same for points that each count as an obstacle.
double distance_to_nearest_m(const std::vector<Eigen::Vector2d>& p_body, const ArcSweep& sweep,
                             double within_m);

}  // namespace adit
