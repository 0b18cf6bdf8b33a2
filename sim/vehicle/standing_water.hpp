// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include <Eigen/Core>

#include "sim/world/world.hpp"

namespace adit {

/// The water that stands highest above a point, if any does.
struct WaterAbove {
  double depth_m = 0.0;
  std::string name;
};
std::optional<WaterAbove> water_above(const World& world, const Eigen::Vector3d& p_world);

}  // namespace adit
