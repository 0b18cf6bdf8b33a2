// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "sim/mesh/triangle_mesh.hpp"

namespace adit {

/// How a file is to be understood.
struct MeshFileParams {
  double scale = 1.0;  ///< metres for one unit of the file
  /// Axis of the file that points up. With y, its x and −z become x and y of world; with x, its y
  /// and z do.
  char up = 'z';
};

/// Reads a mesh of whatever format Assimp knows (OBJ, PLY, DAE, STL, ..): the one place that does.
/// Each mesh of the file becomes a part of the same name, which says what it is (classify_surface).
/// Triangles without area, or with a corner that is not finite, are left out. Throws
/// std::runtime_error, one line with the file, for one that is missing, empty, too large or no
/// mesh, for one without triangles, and for a size that no mine has: the scale is wrong then.
TriangleMesh load_mesh_file(const std::filesystem::path& file, const MeshFileParams& params = {});

}  // namespace adit
