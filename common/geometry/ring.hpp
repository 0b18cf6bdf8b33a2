// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

namespace adit {

/// Whether a closed line encloses a point, by the even-odd rule; its last point may repeat the
/// first. Counts the crossings of a ray along x (Shimrat, "Algorithm 112", 1962).
[[nodiscard]] bool encloses(const std::vector<Eigen::Vector2d>& ring, const Eigen::Vector2d& p);

}  // namespace adit
