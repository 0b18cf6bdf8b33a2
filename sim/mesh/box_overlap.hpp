// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include <Eigen/Core>

#include "sim/mesh/ray_scene.hpp"

namespace adit {

/// Whether a triangle, with its corners in world, and a box have a point in common (separating
/// axes: Akenine-Möller, "Fast 3D triangle-box overlap testing", 2001). False for corners that are
/// not finite.
bool overlaps(const OrientedBox& box, const std::array<Eigen::Vector3d, 3>& triangle);

}  // namespace adit
