// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/mesh/mesh_slice.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

namespace adit {
namespace {

/// An edge of the mesh that the plane crosses, lower index first.
using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// For each vertex the first one at its place.
std::vector<std::uint32_t> first_at_place(const std::vector<Eigen::Vector3f>& vertices) {
  const auto key = [&](std::uint32_t i) {
    return std::tuple(vertices[i].x(), vertices[i].y(), vertices[i].z());
  };
  std::vector<std::uint32_t> finite;
  std::vector<std::uint32_t> first(vertices.size());
  std::iota(first.begin(), first.end(), 0U);
  std::copy_if(first.begin(), first.end(), std::back_inserter(finite),
               [&](std::uint32_t i) { return vertices[i].allFinite(); });
  std::sort(finite.begin(), finite.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(key(a), a) < std::pair(key(b), b);
  });
  for (std::size_t i = 1; i < finite.size(); ++i) {
    if (key(finite[i]) == key(finite[i - 1])) first[finite[i]] = first[finite[i - 1]];
  }
  return first;
}

class Slicer {
 public:
  Slicer(const TriangleMesh& mesh, double z_m)
      : mesh_(mesh), z_m_(z_m), first_(first_at_place(mesh.vertices)) {}

  std::vector<std::vector<Eigen::Vector2d>> loops() {
    for (const TriangleMesh::Triangle& triangle : mesh_.triangles) add(triangle);
    std::vector<std::vector<Eigen::Vector2d>> loops;
    for (const auto& [edge, neighbours] : neighbours_) {
      std::vector<Eigen::Vector2d> loop = follow(edge);
      if (loop.size() > 2) loops.push_back(std::move(loop));
    }
    return loops;
  }

 private:
  [[nodiscard]] bool is_above(std::uint32_t vertex) const {
    return mesh_.vertices[vertex].z() > z_m_;
  }

  /// A triangle with corners on both sides of the plane has two edges that cross it.
  void add(const TriangleMesh::Triangle& triangle) {
    std::vector<Edge> crossed;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax(first_[triangle[i]], first_[triangle[(i + 1) % 3]]);
      if (!mesh_.vertices[low].allFinite() || !mesh_.vertices[high].allFinite()) return;
      if (is_above(low) != is_above(high)) crossed.emplace_back(low, high);
    }
    if (crossed.size() != 2 || crossed[0] == crossed[1]) return;
    neighbours_[crossed[0]].push_back(crossed[1]);
    neighbours_[crossed[1]].push_back(crossed[0]);
  }

  [[nodiscard]] Eigen::Vector2d place(const Edge& edge) const {
    const Eigen::Vector3d a = mesh_.vertices[edge.first].cast<double>();
    const Eigen::Vector3d b = mesh_.vertices[edge.second].cast<double>();
    return (a + (z_m_ - a.z()) / (b.z() - a.z()) * (b - a)).head<2>();
  }

  /// Follows the line from an edge back to itself; empty if the line ends, branches, or was
  /// followed before.
  std::vector<Eigen::Vector2d> follow(const Edge& start) {
    std::vector<Eigen::Vector2d> loop;
    Edge before = start;
    Edge here = start;
    do {
      const std::vector<Edge>& next = neighbours_.at(here);
      if (next.size() != 2 || !done_.insert(here).second) return {};
      loop.push_back(place(here));
      const Edge last = here;
      here = next[0] == before ? next[1] : next[0];
      before = last;
    } while (here != start);
    return loop;
  }

  const TriangleMesh& mesh_;
  double z_m_;
  std::vector<std::uint32_t> first_;
  std::map<Edge, std::vector<Edge>> neighbours_;
  std::set<Edge> done_;
};

}  // namespace

std::vector<std::vector<Eigen::Vector2d>> slice(const TriangleMesh& mesh, double z_m) {
  return Slicer(mesh, z_m).loops();
}

}  // namespace adit
