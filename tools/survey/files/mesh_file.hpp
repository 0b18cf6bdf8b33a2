// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace adit {

/// A surface of triangles, in the grid [m]; the corners of a triangle are counter-clockwise as seen
/// from its side of void.
struct SurfaceMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Writes binary PLY with coordinates in double precision. `comment`: a line. Throws FileError.
void write_mesh_ply(const SurfaceMesh& mesh, const std::string& comment,
                    const std::filesystem::path& path);

/// Writes OBJ with whole millimetres. Throws FileError.
void write_mesh_obj(const SurfaceMesh& mesh, const std::string& comment,
                    const std::filesystem::path& path);

}  // namespace adit
