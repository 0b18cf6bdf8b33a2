// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "common/types/vehicle.hpp"
#include "sim/mesh/ray_scene.hpp"
#include "sim/world/world.hpp"

namespace adit {

/// The name of a part that collides with the body: a solid surface within the footprint, between
/// the belly and the top. Empty if there is no collision.
std::optional<std::string> colliding_part(const RayScene& scene, const Vehicle& vehicle,
                                          const Eigen::Isometry3d& T_world_body);

/// z in world of the lowest surface at a point of the plan with at least the vehicle's height of
/// free space above it. Empty if there is none.
std::optional<double> floor_with_headroom(const RayScene& scene, const Vehicle& vehicle,
                                          const Eigen::Vector2d& p_world);

/// Depth to which a wheel sinks, and the soft ground that causes it.
struct Sinkage {
  double depth_m = 0.0;
  std::string name;  ///< of the soft ground; empty on firm ground
};

/// The greatest sinkage of all soft ground at a point: (1 − (r/R)²)² times the depth at the centre,
/// which falls smoothly to 0 at the rim.
Sinkage sinkage_at(const World& world, const Eigen::Vector2d& p_world);

/// The deepest water above a point; empty if there is none.
struct WaterAbove {
  double depth_m = 0.0;
  std::string name;
};
std::optional<WaterAbove> water_above(const World& world, const Eigen::Vector3d& p_world);

}  // namespace adit
