// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/c_space/footprint.hpp"

#include <algorithm>

namespace adit {

std::vector<ConvexPolygon> wheel_tracks(const Vehicle& vehicle) {
  const Eigen::Vector2d half(vehicle.wheelbase_m / 2.0 + vehicle.wheel_radius_m,
                             vehicle.wheel_width_m / 2.0);
  return {ConvexPolygon::rectangle({0.0, vehicle.track_m / 2.0}, half),
          ConvexPolygon::rectangle({0.0, -vehicle.track_m / 2.0}, half)};
}

bool any_contains(const std::vector<ConvexPolygon>& polygons, const Eigen::Vector2d& p_body) {
  return std::ranges::any_of(
      polygons, [&](const ConvexPolygon& polygon) { return polygon.contains(p_body); });
}

}  // namespace adit
