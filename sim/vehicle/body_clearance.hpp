// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include <Eigen/Geometry>

#include "common/types/vehicle.hpp"
#include "sim/mesh/ray_scene.hpp"

namespace adit {

/// The name of a part that the body touches: anything solid within the footprint, between the belly
/// and the highest point. Nothing where it is free.
std::optional<std::string> colliding_part(const RayScene& scene, const Vehicle& vehicle,
                                          const Eigen::Isometry3d& T_world_body);

/// The lowest surface in the column at a place that has as much room above it as the vehicle is
/// high: z in world. Nothing where there is none.
std::optional<double> floor_with_headroom(const RayScene& scene, const Vehicle& vehicle,
                                          const Eigen::Vector2d& p_world);

}  // namespace adit
