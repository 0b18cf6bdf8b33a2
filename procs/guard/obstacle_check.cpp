// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/guard/obstacle_check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace adit {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

double way_of_beam_m(const Eigen::Vector2d& p_body, const ArcSweep& sweep) {
  return std::isnan(p_body.x()) ? kNever : sweep.way_m(p_body);
}

}  // namespace

double stopping_distance_m(const ObstacleParams& params, double speed_m_s, double age_s) {
  const double speed = std::abs(speed_m_s);
  return speed * (params.reaction_s + age_s) + 0.5 * speed * speed / params.braking_m_s2 +
         params.margin_m;
}

double way_to_obstacle_m(const LaserPoints& points, const ArcSweep& sweep) {
  double nearest = kNever;
  double before = kNever;  // of the neighbouring beam
  for (const Eigen::Vector2d& p_body : points.p_body) {
    const double way = way_of_beam_m(p_body, sweep);
    nearest = std::min(nearest, std::max(before, way));
    before = way;
  }
  return nearest;
}

}  // namespace adit
