// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/mesh/triangle_mesh.hpp"

namespace adit {

/// Tunnels that cross at right angles, with square pillars between them and rough surfaces. The
/// floor is near z = 0. Tunnels start at the multiples of `spacing_m` in x and y, from 0.
struct RoughMine {
  int pillars = 1;          ///< per side
  double spacing_m = 12.0;  ///< between tunnels; the width of a tunnel is a quarter of it
  double height_m = 2.0;
  double grid_m = 0.2;  ///< approximate edge length of the mesh
  double roughness_m = 0.05;
};

TriangleMesh rough_mine(const RoughMine& mine = {});

}  // namespace adit
