// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace adit {

/// Triangles through points of a surface (Cohen-Steiner, Da, "A greedy Delaunay-based surface
/// reconstruction algorithm", The Visual Computer 20, 2004; CGAL, which only this file uses): a
/// manifold with borders whose triangles are faces of the Delaunay triangulation of the points, so
/// that no two of them cross. Edges are at most `edge_max_m`: what has no points stays open.
/// Corners are in the order of one side for each connected part, not the same for all.
std::vector<std::array<std::uint32_t, 3>> front_triangulation(
    const std::vector<Eigen::Vector3d>& points, double edge_max_m);

}  // namespace adit
