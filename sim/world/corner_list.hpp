// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

namespace adit {

/// The points of a list x, y, x, y, .. Throws std::invalid_argument, beginning with `what`, for an
/// odd list, one of fewer than `least` points, or one with a number that is not finite.
std::vector<Eigen::Vector2d> corner_list(const std::vector<double>& numbers, std::size_t least,
                                         const std::string& what);

}  // namespace adit
