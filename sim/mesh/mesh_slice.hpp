// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "sim/mesh/triangle_mesh.hpp"

namespace adit {

/// The closed lines in which a horizontal plane intersects a mesh: x and y of their points, in
/// either orientation. Open and branching lines are dropped. Vertices at the same position count as
/// one.
std::vector<std::vector<Eigen::Vector2d>> slice(const TriangleMesh& mesh, double z_m);

}  // namespace adit
