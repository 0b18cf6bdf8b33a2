// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"
#include "common/types/vehicle.hpp"

namespace adit {

/// An axis-aligned rectangle in the body frame [m].
struct BodyRectangle {
  Eigen::Vector2d middle;
  Eigen::Vector2d half;  ///< half the length and half the width

  [[nodiscard]] bool contains(const Eigen::Vector2d& p_body) const {
    return ((p_body - middle).cwiseAbs().array() <= half.array()).all();
  }
  [[nodiscard]] BodyRectangle grown(double by_m) const {
    return {middle, half + Eigen::Vector2d(by_m, by_m)};
  }
};

/// The outline of the vehicle.
BodyRectangle body_outline(const Vehicle& vehicle);

/// The ground that the wheels of each side touch: a bar from the rear end of the rear wheel to the
/// front end of the front wheel, left and right (the black bars of figure 5c of the paper).
std::vector<BodyRectangle> wheel_tracks(const Vehicle& vehicle);

/// Whether any of the rectangles contains the point.
bool any_contains(const std::vector<BodyRectangle>& rectangles, const Eigen::Vector2d& p_body);

/// Whether a rectangle of a body at the origin with heading `angle_rad` intersects the open square
/// of side 2 · `half_m` around `p`, by the separating axis theorem.
bool meets_square(const BodyRectangle& rectangle, double angle_rad, const Eigen::Vector2d& p,
                  double half_m);

}  // namespace adit
