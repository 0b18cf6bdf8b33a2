// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "tools/sample_mine/synthetic_world.hpp"

namespace adit {

/// The line where a function of the plane is zero, within a rectangle, as segments of about
/// `step_m` (marching squares). Contours do not cross.
std::vector<Segment> zero_contour(const std::function<double(const Eigen::Vector2d&)>& function,
                                  const Eigen::Vector2d& low, const Eigen::Vector2d& high,
                                  double step_m);

}  // namespace adit
