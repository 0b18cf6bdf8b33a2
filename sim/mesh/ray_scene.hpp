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

/// Where a ray meets a mesh first.
struct RayHit {
  float distance_m = 0.0F;
  std::uint32_t triangle = 0;
  Eigen::Vector3f normal;  ///< of the triangle, unit, towards the origin of the ray
};

/// A box that may be turned.
struct OrientedBox {
  Eigen::Isometry3d T_world_box = Eigen::Isometry3d::Identity();  ///< of its centre
  Eigen::Vector3d half_size{0.0, 0.0, 0.0};                       ///< [m]
};

/// A mesh made ready for ray casting and collision tests: Embree behind one class. The same calls
/// give the same bits on one machine: one thread, a fixed instruction set, robust intersection.
class RayScene {
 public:
  /// Water is left out of `solid`: wheels go through it and lasers do not.
  enum class Layer { kOptical, kSolid };

  /// `mesh` must outlive this and stay as it is. Triangles that are degenerate or not finite are
  /// never hit. An empty mesh is a scene of nothing.
  explicit RayScene(const TriangleMesh& mesh);
  ~RayScene();
  RayScene(RayScene&&) noexcept;
  RayScene& operator=(RayScene&&) noexcept;

  [[nodiscard]] std::optional<RayHit> cast(const Ray& ray, float range_max_m,
                                           Layer layer = Layer::kOptical) const;

  /// The same for many rays at once, faster where they lie close together. `hits` is as long as
  /// `rays`; a hit at infinity is none.
  void cast(std::span<const Ray> rays, float range_max_m, std::span<RayHit> hits,
            Layer layer = Layer::kOptical) const;

  /// Indices of the solid triangles that the box touches, ascending.
  [[nodiscard]] std::vector<std::uint32_t> touching(const OrientedBox& box) const;

  [[nodiscard]] const TriangleMesh& mesh() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Whether a triangle, with its corners in world, and a box have a point in common (separating
/// axes: Akenine-Möller, "Fast 3D triangle-box overlap testing", 2001). False for corners that are
/// not finite.
bool overlaps(const OrientedBox& box, const std::array<Eigen::Vector3d, 3>& triangle);

}  // namespace adit
