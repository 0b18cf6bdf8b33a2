// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/c_space/footprint.hpp"

#include <algorithm>
#include <cmath>

namespace adit {

BodyRectangle body_outline(const Vehicle& vehicle) {
  return {{0.0, 0.0}, {vehicle.length_m / 2.0, vehicle.width_m / 2.0}};
}

std::vector<BodyRectangle> wheel_tracks(const Vehicle& vehicle) {
  const Eigen::Vector2d half(vehicle.wheelbase_m / 2.0 + vehicle.wheel_radius_m,
                             vehicle.wheel_width_m / 2.0);
  return {{{0.0, vehicle.track_m / 2.0}, half}, {{0.0, -vehicle.track_m / 2.0}, half}};
}

bool any_contains(const std::vector<BodyRectangle>& rectangles, const Eigen::Vector2d& p_body) {
  return std::any_of(rectangles.begin(), rectangles.end(),
                     [&](const BodyRectangle& rectangle) { return rectangle.contains(p_body); });
}

bool meets_square(const BodyRectangle& rectangle, double angle_rad, const Eigen::Vector2d& p,
                  double half_m) {
  const Eigen::Vector2d x(std::cos(angle_rad), std::sin(angle_rad));
  const Eigen::Vector2d y(-x.y(), x.x());
  const Eigen::Vector2d away = p - (rectangle.middle.x() * x + rectangle.middle.y() * y);
  const Eigen::Vector2d& half = rectangle.half;
  const double square = half_m * (std::abs(x.x()) + std::abs(x.y()));  // along x and along y
  const Eigen::Vector2d spread = half.x() * x.cwiseAbs() + half.y() * y.cwiseAbs();
  return std::abs(away.dot(x)) < half.x() + square && std::abs(away.dot(y)) < half.y() + square &&
         std::abs(away.x()) < spread.x() + half_m && std::abs(away.y()) < spread.y() + half_m;
}

}  // namespace adit
