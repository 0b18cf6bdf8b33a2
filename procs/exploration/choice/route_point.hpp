// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

namespace adit {

/// A place on a route, and the direction of the route there, taken over 1.5 m.
struct RoutePoint {
  Eigen::Vector2d p_map{0.0, 0.0};
  Eigen::Vector2d direction{1.0, 0.0};  ///< of length one
};

/// So far along a route, or its end. The route has a place at least.
RoutePoint point_along(const std::vector<Eigen::Vector2d>& route_map, double distance_m);

/// Places `spacing_m` apart of a line, as far as `length_m` along it; its end, if that is nearer.
std::vector<Eigen::Vector2d> resampled(const std::vector<Eigen::Vector2d>& line, double length_m,
                                       double spacing_m);

}  // namespace adit
