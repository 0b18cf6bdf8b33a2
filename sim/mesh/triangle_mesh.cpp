// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/mesh/triangle_mesh.hpp"

namespace adit {

Eigen::AlignedBox3f mesh_bounds(const TriangleMesh& mesh) {
  Eigen::AlignedBox3f box;
  for (const TriangleMesh::Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t i : triangle) {
      if (mesh.vertices[i].allFinite()) box.extend(mesh.vertices[i]);
    }
  }
  return box;
}

}  // namespace adit
