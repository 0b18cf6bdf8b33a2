// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace adit {

/// Material of a surface: defines its reflectivity and its colour in pictures.
enum class Material : std::uint8_t {
  kRock,
  kTimber,
  kSteel,
  kMud,
  kWater,   ///< absorbs the beam: no return
  kMirror,  ///< still water, which reflects it
};

/// Kind of object that a surface belongs to.
enum class PartKind : std::uint8_t {
  kFloor,
  kRoof,
  kWall,
  kRail,
  kSleeper,
  kPost,
  kCrib,
  kRubble,
  kBeam,
  kCable,
  kCar,
  kWater,
  kOther,  ///< of an imported mesh
};

/// A part of a world, such as the floor or one post.
struct Part {
  PartKind kind = PartKind::kOther;
  Material material = Material::kRock;
  std::string name;  ///< unique within the mesh
};

/// Surfaces in the frame `world` [m], z up. Triangles are hit from both sides.
struct TriangleMesh {
  using Triangle = std::array<std::uint32_t, 3>;  ///< indices into `vertices`

  std::vector<Eigen::Vector3f> vertices;
  std::vector<Triangle> triangles;
  std::vector<std::uint16_t> triangle_parts;  ///< for each triangle, index into `parts`
  std::vector<Part> parts;

  [[nodiscard]] const Part& part_of(std::uint32_t triangle) const {
    return parts[triangle_parts[triangle]];
  }
};

/// Bounding box of all vertices that are finite; empty without any.
inline Eigen::AlignedBox3f mesh_bounds(const TriangleMesh& mesh) {
  Eigen::AlignedBox3f box;
  for (const TriangleMesh::Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t i : triangle) {
      if (mesh.vertices[i].allFinite()) box.extend(mesh.vertices[i]);
    }
  }
  return box;
}

}  // namespace adit
