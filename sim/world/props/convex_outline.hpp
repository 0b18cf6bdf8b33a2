// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

namespace adit {

/// The smallest convex polygon around points, counter-clockwise (Andrew's monotone chain, 1979).
/// Fewer than three corners where the points lie on one line.
std::vector<Eigen::Vector2d> convex_outline(std::vector<Eigen::Vector2d> points);

}  // namespace adit
