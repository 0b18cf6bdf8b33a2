// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include <Eigen/Geometry>

#include "common/types/vehicle.hpp"
#include "sim/mesh/ray_scene.hpp"

namespace adit {

/// The name of a part that collides with the body: a solid surface within the footprint, between
/// the belly and the top. Empty if there is no collision.
std::optional<std::string> colliding_part(const RayScene& scene, const Vehicle& vehicle,
                                          const Eigen::Isometry3d& T_world_body);

/// z in world of the lowest surface at a point of the plan with at least the vehicle's height of
/// free space above it. Empty if there is none.
std::optional<double> floor_with_headroom(const RayScene& scene, const Vehicle& vehicle,
                                          const Eigen::Vector2d& p_world);

}  // namespace adit
