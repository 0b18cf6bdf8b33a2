// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/config/bounds.hpp"
#include "procs/guard/arc_sweep.hpp"
#include "procs/guard/laser_points.hpp"

namespace adit {

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
double way_to_obstacle_m(const LaserPoints& points, const ArcSweep& sweep, double within_m);

/// The same for points each of which is believed.
double way_to_nearest_m(const std::vector<Eigen::Vector2d>& p_body, const ArcSweep& sweep,
                        double within_m);

}  // namespace adit
