// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "sim/world/random/random_generator.hpp"
#include "sim/world/world_description.hpp"

namespace adit {

/// A line of the given length with small random bends about its direction.
std::vector<Eigen::Vector2d> wandering_line(const Eigen::Vector2d& from, double heading_rad,
                                            double length_m, RandomGenerator& rng);

/// The tunnel along a line.
TunnelDescription tunnel_along(const std::string& name, const std::vector<Eigen::Vector2d>& line,
                               double width_m);

/// `main`, from the origin along x, straight for `kUndamagedLength`, with random bends beyond.
TunnelDescription main_tunnel(double length_m, RandomGenerator& rng);

}  // namespace adit
