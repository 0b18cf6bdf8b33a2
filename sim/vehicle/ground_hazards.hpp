// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include <Eigen/Core>

#include "sim/world/world.hpp"

namespace adit {

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
