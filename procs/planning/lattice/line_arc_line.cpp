// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/lattice/line_arc_line.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace adit {
namespace {

constexpr double kLengthTolerance = 1e-9;  // rounding of lengths that are 0 [m]

}  // namespace

double LineArcLine::arc_m() const { return radius_m * std::abs(turn_rad); }

Pose2 LineArcLine::pose_at(double distance_m) const {
  const double in = std::clamp(distance_m, 0.0, line_in_m);
  const double arc = std::clamp(distance_m - line_in_m, 0.0, arc_m());
  const double out = std::max(0.0, distance_m - line_in_m - arc_m());
  const Pose2 T_0_arc{in, 0.0, 0.0};
  if (arc == 0.0) return T_0_arc * Pose2{out, 0.0, 0.0};
  const double turn = std::copysign(arc / radius_m, turn_rad);
  const double side = std::copysign(radius_m, turn_rad);
  return T_0_arc * Pose2{side * std::sin(turn), side * (1.0 - std::cos(turn)), turn} *
         Pose2{out, 0.0, 0.0};
}

double LineArcLine::curvature_at(double distance_m) const {
  if (distance_m < line_in_m || distance_m >= line_in_m + arc_m()) return 0.0;
  return std::copysign(1.0 / radius_m, turn_rad);
}

std::optional<LineArcLine> line_arc_line_to(const Pose2& end, double radius_min_m) {
  const double turn = std::abs(end.theta);
  const double s = std::sin(turn);
  const double round = 1.0 - std::cos(turn);
  const double x = end.x;
  const double y = std::copysign(1.0, end.theta) * end.y;
  // x = in + r sin + out cos and y = r (1 − cos) + out sin leave one of in, r, out free. In the
  // shortest curve the line after the arc or before it has no length, or r is minimal.
  const std::array<double, 3> radii{y / round, (x * s - y * (1.0 - round)) / round, radius_min_m};
  std::optional<LineArcLine> best;
  for (const double radius : radii) {
    if (radius < radius_min_m - kLengthTolerance) continue;
    const double out = (y - radius * round) / s;
    const double in = x - radius * s - out * (1.0 - round);
    if (in < -kLengthTolerance || out < -kLengthTolerance) continue;
    const LineArcLine found{std::max(in, 0.0), radius, end.theta, std::max(out, 0.0)};
    if (!best || found.length_m() < best->length_m() - kLengthTolerance) best = found;
  }
  return best;
}

}  // namespace adit
