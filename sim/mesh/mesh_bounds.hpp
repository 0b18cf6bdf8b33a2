// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include "sim/mesh/triangle_mesh.hpp"

namespace adit {

/// A box around all triangles, but for corners that are not finite; empty where there is none.
Eigen::AlignedBox3f mesh_bounds(const TriangleMesh& mesh);

}  // namespace adit
