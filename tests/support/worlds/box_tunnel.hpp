// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "sim/mesh/mesh_builder.hpp"
#include "sim/world/world.hpp"

namespace adit {

/// A straight tunnel of flat surfaces along x, from x = −length/2 to length/2, closed at its ends.
/// The floor is z = 0 and the centre line y = 0. The robot starts at the origin, facing along x.
struct BoxTunnel {
  double length_m = 40.0;
  double width_m = 4.0;
  double height_m = 2.0;
};

/// Builds the tunnel. `add` may add objects to its mesh.
World box_tunnel(
    const BoxTunnel& tunnel = {},
    const std::function<void(MeshBuilder&)>& add = [](MeshBuilder&) {});

/// An axis-aligned box by its centre and size, in world [m].
OrientedBox level_box(const Eigen::Vector3d& middle, const Eigen::Vector3d& size);

}  // namespace adit
