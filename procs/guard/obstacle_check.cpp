// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/guard/obstacle_check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace adit {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

}  // namespace

double stopping_distance_m(const ObstacleParams& params, double speed_m_s, double age_s) {
  const double speed = std::abs(speed_m_s);
  return speed * (params.reaction_s + age_s) + 0.5 * speed * speed / params.braking_m_s2 +
         params.margin_m;
}

double way_to_obstacle_m(const LaserPoints& points, const ArcSweep& sweep, double within_m) {
  const double reach_m = sweep.reach_m(within_m);
  double nearest = kNever;
  double before = kNever;  // of the neighbouring beam
  for (const Eigen::Vector2d& p_body : points.p_body) {
    const bool near = p_body.squaredNorm() <= reach_m * reach_m;  // not where there is nothing: NaN
    const double way = near ? sweep.way_m(p_body) : kNever;
    nearest = std::min(nearest, std::max(before, way));
    before = way;
  }
  return nearest < within_m ? nearest : kNever;
}

double way_to_nearest_m(const std::vector<Eigen::Vector2d>& p_body, const ArcSweep& sweep,
                        double within_m) {
  double nearest = kNever;
  for (const Eigen::Vector2d& p : p_body) nearest = std::min(nearest, sweep.way_m(p));
  return nearest < within_m ? nearest : kNever;
}

}  // namespace adit
