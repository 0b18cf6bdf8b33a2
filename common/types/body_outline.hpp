// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/geometry/convex_polygon.hpp"
#include "common/types/vehicle.hpp"

namespace adit {

/// The outline of the vehicle from above, in the body frame: the convex hull of
/// `vehicle.footprint`, or the rectangle of its length and width if that is empty. Throws
/// std::invalid_argument unless the footprint is symmetric about both axes, as planning takes the
/// vehicle to fit the same with either end ahead, and as long and wide as `vehicle.length_m` and
/// `width_m` say, both to 1 mm.
ConvexPolygon body_outline(const Vehicle& vehicle);

/// The vehicle with its outline moved outwards by a margin on each side, or inwards by a negative
/// one; its wheels, height and belly as before. Throws as body_outline does.
Vehicle with_outline_grown(Vehicle vehicle, double by_m);

}  // namespace adit
