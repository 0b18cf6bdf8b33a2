// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "sim/mesh/triangle_mesh.hpp"

namespace adit {

/// Scale and axes of a mesh file.
struct MeshFileParams {
  double scale = 1.0;  ///< metres per unit of the file
  /// Axis of the file that points up. With y, its x and −z become x and y of world; with x, its y
  /// and z do.
  char up = 'z';
};

/// Reads a mesh file of any format of Assimp (OBJ, PLY, DAE, STL, ..), which only this file uses.
/// Each mesh of the file becomes a part of the same name; a keyword in it, case-insensitive,
/// defines kind and material: `floor`, `roof`, `wall`, `rail`, `sleeper`, `post`, `crib`, `rubble`,
/// `beam`, `cable`, `car` or `water`. Without one it is rock of kind `kOther`. Triangles without
/// area or with a vertex that is not finite are dropped. Throws std::runtime_error, one line with
/// the file name, for a file that is missing, empty, too large, not a mesh or without triangles,
/// and for an extent beyond that of a mine, which indicates a wrong scale.
TriangleMesh load_mesh_file(const std::filesystem::path& file, const MeshFileParams& params = {});

}  // namespace adit
