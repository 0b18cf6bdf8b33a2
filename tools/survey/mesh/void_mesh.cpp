// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/mesh/void_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <tuple>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include <Eigen/Geometry>
#include <malloc.h>

#include "common/geometry/symmetric_eigen.hpp"
#include "tools/survey/mesh/front_triangulation.hpp"
#include "tools/survey/points/point_index.hpp"
#include "tools/survey/points/thinned_points.hpp"

namespace adit {
namespace {

constexpr double kReturnsM = 0.06;  // between returns that are looked at, and if these are more
constexpr std::size_t kReturnsPerVertex = 8;  // than so many per vertex, twice that, and so on
constexpr int kSmoothMin = 8;                 // points of a plane

/// Sets of elements that are joined (union by the smaller number, paths halved).
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t size) : parent_(size) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> parent_;
};

/// An edge of a triangle, from its smaller vertex to the larger one.
struct EdgeUse {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  std::uint32_t triangle = 0;
  bool along = false;  ///< whether the triangle runs from `from` to `to`

  [[nodiscard]] std::pair<std::uint32_t, std::uint32_t> edge() const { return {from, to}; }
};

/// Calls `visit` with the uses of each edge.
template <class Visit>
void for_each_edge(const SurfaceMesh& mesh, Visit visit) {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = mesh.triangles[t][i];
      const std::uint32_t b = mesh.triangles[t][(i + 1) % 3];
      uses.push_back({std::min(a, b), std::max(a, b), static_cast<std::uint32_t>(t), a < b});
    }
  }
  std::ranges::sort(uses, {},
                    [](const EdgeUse& use) { return std::tuple(use.from, use.to, use.triangle); });
  for (std::size_t first = 0; first < uses.size();) {
    std::size_t last = first + 1;
    while (last < uses.size() && uses[last].edge() == uses[first].edge()) ++last;
    visit(std::span<const EdgeUse>(uses).subspan(first, last - first));
    first = last;
  }
}

/// The part of each triangle, connected by edges: a number of one of its triangles.
std::vector<std::size_t> parts_of(const SurfaceMesh& mesh) {
  DisjointSets sets(mesh.triangles.size());
  for_each_edge(mesh, [&](std::span<const EdgeUse> uses) {
    for (const EdgeUse& use : uses) sets.join(uses.front().triangle, use.triangle);
  });
  std::vector<std::size_t> parts(mesh.triangles.size());
  for (std::size_t t = 0; t < parts.size(); ++t) parts[t] = sets.find(t);
  return parts;
}

/// Twice the area, along the normal of the side.
Eigen::Vector3d cross_of(const SurfaceMesh& mesh, std::size_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  return (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]);
}

/// A vertex of the mesh before it has triangles, and the direction to the laser that saw it.
struct MeshPoints {
  std::vector<Eigen::Vector3d> places;
  std::vector<Eigen::Vector3d> to_laser;
  double spacing_m = 0.0;
};

/// The spacing of the parameters, or a larger one that keeps to the number of vertices. `points`:
/// one per cube of side `voxel_m`, at most.
double spacing_of(const std::vector<ComparedPoint>& points, double voxel_m,
                  const VoidMeshParams& params) {
  const double side_m = std::max(voxel_m, params.spacing_m);
  std::unordered_set<std::uint64_t> voxels;
  for (const ComparedPoint& point : points)
    voxels.insert(voxel_key(Eigen::Vector3d(point.p.cast<double>()), side_m));
  const double ratio =
      static_cast<double>(voxels.size()) / static_cast<double>(params.vertices_max);
  return std::max(params.spacing_m, side_m * std::sqrt(ratio));
}

/// One point per voxel, moved onto the mean plane of the returns around it.
MeshPoints mesh_points(const RegisteredCloud& cloud, const VoidMeshParams& params) {
  ThinnedPoints thinned(kReturnsM, kReturnsPerVertex * params.vertices_max);
  std::vector<Eigen::Vector3d> lasers;  // by line
  for (const PlacedCloud& scan : cloud.scans()) {
    for (const CloudLine& line : cloud.lines_of(scan)) {
      const auto number = static_cast<std::uint32_t>(lasers.size());
      lasers.push_back(scan.in_survey(line.origin.cast<double>()));
      for (const Eigen::Vector3f& p_level : line.points) {
        if ((p_level - line.origin).norm() > static_cast<float>(params.range_max_m)) continue;
        thinned.add({scan.in_survey(p_level.cast<double>()).cast<float>(), number});
      }
    }
  }
  const double voxel_m = thinned.voxel_m();
  std::vector<ComparedPoint> points = std::move(thinned).release();
  MeshPoints result;
  const double spacing_m = result.spacing_m = spacing_of(points, voxel_m, params);
  const double smooth_m = params.smooth_m * std::max(1.0, voxel_m / kReturnsM / 2.0);
  const PointIndex index(std::move(points), smooth_m);
  std::unordered_set<std::uint64_t> voxels;
  for (const ComparedPoint& point : index.points()) {
    Eigen::Vector3d p = point.p.cast<double>();
    if (!voxels.insert(voxel_key(p, spacing_m)).second) continue;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
    int count = 0;
    index.for_each_around(p, smooth_m, [&](const ComparedPoint& other) {
      const Eigen::Vector3d d = other.p.cast<double>() - p;
      sum += d;
      squares += d * d.transpose();
      ++count;
    });
    if (count < kSmoothMin) continue;  // a stray
    const Eigen::Vector3d mean = sum / count;
    const auto eigen = symmetric_eigen(Eigen::Matrix3d(squares / count - mean * mean.transpose()));
    const Eigen::Vector3d n = eigen.vectors.col(0);
    if (eigen.values[0] < 0.1 * eigen.values[1]) p += n.dot(mean) * n;
    result.places.push_back(p);
    result.to_laser.push_back((lasers[point.scan] - p).normalized());
  }
  return result;
}

/// Turns parts whose side is away from the lasers, and leaves out those that are small, with the
/// vertices that no triangle has then.
SurfaceMesh sided_mesh(const SurfaceMesh& mesh, const std::vector<Eigen::Vector3d>& to_laser,
                       double part_min_m2) {
  const std::vector<std::size_t> parts = parts_of(mesh);
  std::vector<double> towards(mesh.triangles.size(), 0.0);
  std::vector<double> area_m2(mesh.triangles.size(), 0.0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Eigen::Vector3d cross = cross_of(mesh, t);
    area_m2[parts[t]] += 0.5 * cross.norm();
    towards[parts[t]] += cross.dot(to_laser[mesh.triangles[t][0]]);
  }
  SurfaceMesh sided;
  std::unordered_map<std::uint32_t, std::uint32_t> number;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (area_m2[parts[t]] < part_min_m2) continue;
    std::array<std::uint32_t, 3> corners = mesh.triangles[t];
    if (towards[parts[t]] < 0.0) std::swap(corners[1], corners[2]);
    for (std::uint32_t& corner : corners) {
      const auto [entry, is_new] =
          number.try_emplace(corner, static_cast<std::uint32_t>(sided.vertices.size()));
      if (is_new) sided.vertices.push_back(mesh.vertices[corner]);
      corner = entry->second;
    }
    sided.triangles.push_back(corners);
  }
  return sided;
}

}  // namespace

SurfaceMesh void_mesh(const RegisteredCloud& cloud, const VoidMeshParams& params) {
  MeshPoints points = mesh_points(cloud, params);
  malloc_trim(0);  // the returns that were looked at, before the triangulation takes as much
  SurfaceMesh mesh;
  mesh.triangles =
      front_triangulation(points.places, params.edge_max_m * points.spacing_m / params.spacing_m);
  mesh.vertices = std::move(points.places);
  return sided_mesh(mesh, points.to_laser, params.part_min_m2);
}

MeshCheck check_mesh(const SurfaceMesh& mesh) {
  MeshCheck check;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    check.area_m2 += 0.5 * cross_of(mesh, t).norm();
  const std::vector<std::size_t> parts = parts_of(mesh);
  for (std::size_t t = 0; t < parts.size(); ++t) check.parts += parts[t] == t ? 1 : 0;
  DisjointSets border(mesh.vertices.size());
  std::vector<bool> on_border(mesh.vertices.size(), false);
  for_each_edge(mesh, [&](std::span<const EdgeUse> uses) {
    const EdgeUse& first = uses.front();
    if (uses.size() == 1) {
      check.border_m += (mesh.vertices[first.from] - mesh.vertices[first.to]).norm();
      on_border[first.from] = on_border[first.to] = true;
      border.join(first.from, first.to);
    } else if (uses.size() > 2 || first.along == uses[1].along) {
      ++check.crossed_edges;
    }
  });
  for (std::size_t i = 0; i < on_border.size(); ++i) {
    if (on_border[i] && border.find(i) == i) ++check.border_loops;
  }
  return check;
}

}  // namespace adit
