// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

namespace adit {

/// A regular polygon around a circle, counter-clockwise, p_world [m].
std::vector<Eigen::Vector2d> around_circle(const Eigen::Vector2d& middle, double radius_m);

}  // namespace adit
