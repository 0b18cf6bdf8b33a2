// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/config/bounds.hpp"
#include "common/types/vehicle.hpp"
#include "procs/guard/laser_monitor.hpp"

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
  [[nodiscard]] double distance_m(const Eigen::Vector2d& p_body) const;

  /// Nothing farther from the body's origin than this is met within the way [m].
  [[nodiscard]] double reach_m(double distance_m) const;

 private:
  struct Rectangle {
    double x_m;                 ///< half the length
    double y_m;                 ///< half the width
    double radius_min_m = 0.0;  ///< of the ring about the centre in which it lies
    double radius_max_m = 0.0;

    [[nodiscard]] bool contains(const Eigen::Vector2d& p_body) const;
  };

  [[nodiscard]] Rectangle rectangle(double x_m, double y_m) const;
  [[nodiscard]] double distance_m(const Eigen::Vector2d& p_body, const Rectangle& footprint) const;
  [[nodiscard]] double straight_distance_m(const Eigen::Vector2d& p_body,
                                           const Rectangle& footprint) const;
  [[nodiscard]] double turn_rad(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;

  double direction_;  ///< 1 forward, -1 in reverse
  double curvature_1_m_;
  bool straight_;
  Eigen::Vector2d centre_{0.0, 0.0};  ///< of the circle, in the body frame
  Rectangle footprint_;
  Rectangle widened_footprint_;
};

struct ObstacleParams {
  double reaction_s = 0.1;    ///< from a scan to the brakes: messages, the timer of this stage
  double braking_m_s2 = 0.6;  ///< that the vehicle reaches for certain
  double margin_m = 0.15;     ///< that is to be left; more than what the lasers are blind for
  double side_margin_m = 0.05;

  template <class V>
  void visit(V& v) {
    v("reaction_s", reaction_s, within(0.0, 5.0));
    v("braking_m_s2", braking_m_s2, above(0.0));
    v("margin_m", margin_m, at_least(0.0));
    v("side_margin_m", side_margin_m, at_least(0.0));
  }
};

/// Which way the vehicle needs to come to a stand, with the margin [m]. `age_s` is that of what it
/// sees.
double stopping_distance_m(const ObstacleParams& params, double speed_m_s, double age_s);

/// Way of the body's origin to the first obstacle [m], infinity without one that is nearer than
/// `within_m`. Two neighbouring beams
/// must meet it: one alone may be a mixed pixel, dust or a drop of water. At half a degree a post
/// of 4 cm is met by two beams up to 2 m away, a cable of 1 cm up to half a metre: nearer than the
/// stopping distance from about 0.6 m/s on, and so in time for this vehicle as a rule, not for
/// certain.
double distance_to_obstacle_m(const LaserPoints& points, const ArcSweep& sweep, double within_m);

/// The same for points each of which is believed.
double distance_to_nearest_m(const std::vector<Eigen::Vector2d>& p_body, const ArcSweep& sweep,
                             double within_m);

}  // namespace adit
