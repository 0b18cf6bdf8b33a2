// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "sim/mesh/triangle_mesh.hpp"

namespace adit {

/// In the frame `world`; the direction is a unit vector.
struct Ray {
  Eigen::Vector3f origin;
  Eigen::Vector3f direction;
};

/// The first intersection of a ray with a mesh.
struct RayHit {
  float distance_m = 0.0F;
  std::uint32_t triangle = 0;
  Eigen::Vector3f normal;  ///< unit normal of the triangle, towards the origin of the ray
};

/// A box of any orientation.
struct OrientedBox {
  Eigen::Isometry3d T_world_box = Eigen::Isometry3d::Identity();  ///< pose of its centre
  Eigen::Vector3d half_size{0.0, 0.0, 0.0};                       ///< [m]
};

/// Ray casting and collision tests against a mesh. The only class that uses Embree. Deterministic
/// on one machine: one thread, a fixed instruction set, robust intersection.
class RayScene {
 public:
  /// kSolid excludes water, which stops lasers but not wheels.
  enum class Layer { kOptical, kSolid };

  /// `mesh` must outlive this and must not change. Degenerate triangles and those that are not
  /// finite are never hit. The mesh may be empty.
  explicit RayScene(const TriangleMesh& mesh);
  ~RayScene();
  RayScene(RayScene&&) noexcept;
  RayScene& operator=(RayScene&&) noexcept;

  [[nodiscard]] std::optional<RayHit> cast(const Ray& ray, float range_max_m,
                                           Layer layer = Layer::kOptical) const;

  /// Casts many rays, which is faster if they are close together. `hits` has the size of `rays`; an
  /// infinite distance means no hit.
  void cast(std::span<const Ray> rays, float range_max_m, std::span<RayHit> hits,
            Layer layer = Layer::kOptical) const;

  /// Indices of the solid triangles that intersect the box, ascending.
  [[nodiscard]] std::vector<std::uint32_t> touching(const OrientedBox& box) const;

  [[nodiscard]] const TriangleMesh& mesh() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Whether a triangle with vertices in world intersects a box (separating axes: Akenine-Möller,
/// "Fast 3D triangle-box overlap testing", 2001). False for corners that are not finite.
bool overlaps(const OrientedBox& box, const std::array<Eigen::Vector3d, 3>& triangle);

}  // namespace adit
