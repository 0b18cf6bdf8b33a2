// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "sim/mesh/triangle_mesh.hpp"

namespace adit {

/// The closed lines in which a level plane cuts a mesh, x and y of their points, in no particular
/// sense. Lines that do not close are left out, and those that branch. Vertices at the same place
/// are one.
std::vector<std::vector<Eigen::Vector2d>> slice(const TriangleMesh& mesh, double z_m);

}  // namespace adit
