// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/mesh/triangle_mesh.hpp"

namespace adit {

/// Drifts that cross at right angles, with square pillars between them and rough surfaces; the
/// floor is about z = 0. One begins at each multiple of `spacing_m` in x and in y from 0 on.
struct RoughMine {
  int pillars = 1;          ///< along each side
  double spacing_m = 12.0;  ///< from tunnel to tunnel; a tunnel is a quarter of it wide
  double height_m = 2.0;
  double grid_m = 0.2;  ///< length of the edges of the mesh, about
  double roughness_m = 0.05;
};

TriangleMesh rough_mine(const RoughMine& mine = {});

}  // namespace adit
