// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include <Eigen/Core>

#include "sim/world/world.hpp"

namespace adit {

/// How deep a wheel sinks, and into what.
struct Sinkage {
  double depth_m = 0.0;
  std::string name;  ///< of the soft ground; empty on firm ground
};

/// The deepest of all soft ground at a place: (1 − (r/R)²)² of the depth in the middle, which falls
/// to the rim without an edge.
Sinkage sinkage_at(const World& world, const Eigen::Vector2d& p_world);

/// The water that stands highest above a point, if any does.
struct WaterAbove {
  double depth_m = 0.0;
  std::string name;
};
std::optional<WaterAbove> water_above(const World& world, const Eigen::Vector3d& p_world);

}  // namespace adit
