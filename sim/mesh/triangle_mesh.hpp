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

/// What a surface is made of: how a laser sees it, and what it looks like.
enum class Material : std::uint8_t {
  kRock,
  kTimber,
  kSteel,
  kMud,
  kWater,   ///< swallows the beam: no return
  kMirror,  ///< still water, which reflects it
};

/// What a surface belongs to.
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
  kOther,  ///< of a mesh from elsewhere
};

/// A piece of a world, such as the floor or one post.
struct Part {
  PartKind kind = PartKind::kOther;
  Material material = Material::kRock;
  std::string name;  ///< unique within the mesh
};

/// Surfaces in the frame `world` [m], z up. Either side of a triangle is solid to look at.
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

/// A box around all triangles, but for corners that are not finite; empty where there is none.
Eigen::AlignedBox3f mesh_bounds(const TriangleMesh& mesh);

}  // namespace adit
