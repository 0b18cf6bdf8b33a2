// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"
#include "common/types/vehicle.hpp"

namespace adit {

/// A rectangle in the body frame, its sides along the axes [m].
struct BodyRectangle {
  Eigen::Vector2d middle;
  Eigen::Vector2d half;  ///< of its length and width

  [[nodiscard]] bool contains(const Eigen::Vector2d& p_body) const {
    return ((p_body - middle).cwiseAbs().array() <= half.array()).all();
  }
  [[nodiscard]] BodyRectangle grown(double by_m) const {
    return {middle, half + Eigen::Vector2d(by_m, by_m)};
  }
};

/// What is above the ground: the whole vehicle.
BodyRectangle body_outline(const Vehicle& vehicle);

/// What the wheels of a side stand on or come over: a bar from the rear end of the rear wheel to
/// the front end of the front wheel (the black bars of the paper's figure 5c), left and right.
std::vector<BodyRectangle> wheel_tracks(const Vehicle& vehicle);

/// Whether any of these contains the point.
bool any_contains(const std::vector<BodyRectangle>& rectangles, const Eigen::Vector2d& p_body);

/// Whether a rectangle on a body that is turned by `angle_rad` meets the open square round `p` with
/// sides of 2 · `half_m` along the axes: the theorem of separating axes.
bool meets_square(const BodyRectangle& rectangle, double angle_rad, const Eigen::Vector2d& p,
                  double half_m);

}  // namespace adit
