// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/geometry/convex_polygon.hpp"
#include "common/types/vehicle.hpp"

namespace adit {

/// The ground that the wheels of each side touch: a bar from the rear end of the rear wheel to the
/// front end of the front wheel, left and right (the black bars of figure 5c of the paper).
std::vector<ConvexPolygon> wheel_tracks(const Vehicle& vehicle);

/// Whether any of the polygons contains the point.
bool any_contains(const std::vector<ConvexPolygon>& polygons, const Eigen::Vector2d& p_body);

}  // namespace adit
