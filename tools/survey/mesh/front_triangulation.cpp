// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/mesh/front_triangulation.hpp"

#include <cstddef>
#include <iterator>

#include <CGAL/Advancing_front_surface_reconstruction.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

namespace adit {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// The order in which the front takes triangles: the smallest circle first; none with a long edge.
struct ShortEdgesOnly {
  double squared_edge_max = 0.0;

  template <class Front, class Cell>
  double operator()(const Front& front, Cell& cell, const int& index) const {
    for (int i = 1; i <= 3; ++i) {
      const auto& a = cell->vertex((index + i) % 4)->point();
      const auto& b = cell->vertex((index + 1 + i % 3) % 4)->point();
      if (CGAL::squared_distance(a, b) > squared_edge_max) return front.infinity();
    }
    return front.smallest_radius_delaunay_sphere(cell, index);
  }
};

}  // namespace

std::vector<std::array<std::uint32_t, 3>> front_triangulation(
    const std::vector<Eigen::Vector3d>& points, double edge_max_m) {
  std::vector<Kernel::Point_3> sites;
  sites.reserve(points.size());
  for (const Eigen::Vector3d& p : points) sites.emplace_back(p.x(), p.y(), p.z());
  std::vector<std::array<std::size_t, 3>> facets;
  if (sites.size() > 3) {
    CGAL::advancing_front_surface_reconstruction(sites.begin(), sites.end(),
                                                 std::back_inserter(facets),
                                                 ShortEdgesOnly{edge_max_m * edge_max_m});
  }
  std::vector<std::array<std::uint32_t, 3>> triangles;
  triangles.reserve(facets.size());
  for (const auto& facet : facets) {
    triangles.push_back({static_cast<std::uint32_t>(facet[0]), static_cast<std::uint32_t>(facet[1]),
                         static_cast<std::uint32_t>(facet[2])});
  }
  return triangles;
}

}  // namespace adit
