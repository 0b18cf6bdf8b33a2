// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "sim/mesh/mesh_builder.hpp"
#include "sim/world/world.hpp"

namespace adit {

/// What no description of a world has: hung up, laid or thrown into a drift by hand.
using AddThings = std::function<void(MeshBuilder&, const World&)>;

/// Puts things into a world that is built.
void add_things(World& world, const AddThings& add);

/// A cable from `from` to `to`, both in world, that hangs `sag_m` below the line between them in
/// its middle.
void add_cable(MeshBuilder& builder, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
               double sag_m, double diameter_m);

/// A box, the axes of which are those of `T_world_plan`, turned by `tilt_rad` about its x.
OrientedBox plan_box(const Pose2& T_world_plan, double middle_m, const Eigen::Vector3d& size,
                     double tilt_rad = 0.0);

}  // namespace adit
