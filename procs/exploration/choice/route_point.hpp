// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace adit {

/// A point on a route and the direction of the route there, over a baseline of 1.5 m.
struct RoutePoint {
  Eigen::Vector2d p_map{0.0, 0.0};
  Eigen::Vector2d direction{1.0, 0.0};  ///< unit vector
  std::size_t index = 0;                ///< of the point in the route
};

/// The point at a distance along a route, or its end. The route must not be empty.
RoutePoint point_along(const std::vector<Eigen::Vector2d>& route_map, double distance_m);

/// Points `spacing_m` apart along a polyline, up to `length_m`; with its end if that is nearer. The
/// line must not be empty.
std::vector<Eigen::Vector2d> resampled(const std::vector<Eigen::Vector2d>& line, double length_m,
                                       double spacing_m);

}  // namespace adit
