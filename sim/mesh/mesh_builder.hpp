// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "sim/mesh/ray_scene.hpp"
#include "sim/mesh/triangle_mesh.hpp"

namespace adit {

/// Builds a mesh of parts from shapes. Coordinates are in world. Throws std::invalid_argument
/// beyond the limits on triangles, vertices and parts of a world.
class MeshBuilder {
 public:
  /// Limit on triangles and on vertices. With the ray casting tree, such a world takes 2 GB.
  static constexpr std::size_t kTrianglesMax = 8'000'000;

  /// Begins a new part, to which all following shapes belong. A number is appended to a duplicate
  /// name.
  void begin_part(PartKind kind, Material material, const std::string& name);

  /// Moves selected triangles, by their part and centre, to the current part.
  void reassign(
      const std::function<bool(const Part& part, const Eigen::Vector3f& middle)>& is_chosen);

  /// Reserves memory for additional elements.
  void reserve(std::size_t vertices, std::size_t triangles);

  /// Returns the index of the vertex.
  std::uint32_t vertex(const Eigen::Vector3f& p_world);
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
  void quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d);

  void box(const OrientedBox& box);
  /// A cylinder between two points, with flat ends.
  void bar(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius_m, int sides = 12);
  /// A tube along a polyline, open at its ends.
  void tube(std::span<const Eigen::Vector3d> line, double radius_m, int sides = 8);

  [[nodiscard]] const TriangleMesh& mesh() const { return mesh_; }
  [[nodiscard]] TriangleMesh take() { return std::move(mesh_); }

 private:
  [[nodiscard]] std::uint16_t current_part() const {
    return static_cast<std::uint16_t>(mesh_.parts.size() - 1);
  }
  std::vector<std::uint32_t> ring(const Eigen::Vector3d& centre, const Eigen::Vector3d& axis,
                                  double radius_m, int sides);

  TriangleMesh mesh_;
  std::set<std::string> names_;         ///< of the parts
  std::map<std::string, int> repeats_;  ///< number of duplicates of each name
};

}  // namespace adit
