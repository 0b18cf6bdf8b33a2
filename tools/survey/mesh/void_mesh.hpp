// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "tools/survey/files/mesh_file.hpp"
#include "tools/survey/frame/registered_cloud.hpp"

namespace adit {

struct VoidMeshParams {
  double spacing_m = 0.12;             ///< of vertices
  std::size_t vertices_max = 600'000;  ///< with more the spacing, and edge_max_m, grow
  double smooth_m = 0.25;              ///< radius of the points that a vertex is the mean plane of
  double edge_max_m = 0.4;             ///< across less the surface is taken to continue
  double range_max_m = 12.0;           ///< of returns
  double part_min_m2 = 1.0;            ///< smaller parts are strays
};

/// Edges of a mesh and what they say of it.
struct MeshCheck {
  double area_m2 = 0.0;
  std::size_t parts = 0;          ///< connected by edges
  std::size_t crossed_edges = 0;  ///< of more than two triangles, or of two with opposite sides
  std::size_t border_loops = 0;   ///< 0: watertight
  double border_m = 0.0;          ///< length of all borders
};

MeshCheck check_mesh(const SurfaceMesh& mesh);

/// The surface of the void where it was seen, in survey; open where it was not. Sides are towards
/// the lasers.
SurfaceMesh void_mesh(const RegisteredCloud& cloud, const VoidMeshParams& params = {});

}  // namespace adit
