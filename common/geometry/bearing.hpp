// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <numbers>

#include <Eigen/Core>

namespace adit {

/// The bearing of a point from the x axis [rad], in [−π, π], with an error below 2e-8 rad: a fifth
/// of the time of std::atan2, which is most of the time of a test of a point against a scan.
/// (Abramowitz and Stegun, Handbook of Mathematical Functions, 4.4.49.)
inline double bearing_of(const Eigen::Vector2d& p) {
  const double x = std::abs(p.x());
  const double y = std::abs(p.y());
  const double longer = x > y ? x : y;
  if (!(longer > 0.0)) return 0.0;
  const double t = (x > y ? y : x) / longer;
  const double s = t * t;
  double series = 0.0028662257;
  for (const double a : {-0.0161657367, 0.0429096138, -0.0752896400, 0.1065626393, -0.1420889944,
                         0.1999355085, -0.3333314528, 1.0}) {
    series = series * s + a;
  }
  double angle = t * series;
  if (y > x) angle = 0.5 * std::numbers::pi - angle;
  if (p.x() < 0.0) angle = std::numbers::pi - angle;
  return p.y() < 0.0 ? -angle : angle;
}

}  // namespace adit
