// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "sim/world/random/random_generator.hpp"
#include "sim/world/world_description.hpp"

namespace adit {

/// Length of the tunnel behind the entrance without branches and props [m].
constexpr double kUndamagedLength = 24.0;

// Plans with about `length_m` of tunnels, 2.5 to 6 m wide. The first tunnel is `main`, which begins
// at the origin along x and is the entrance. A length too short for the topology gives `main`
// alone.

/// Two or three parallel tunnels with crosscuts.
PlanDescription parallel_entries(double length_m, RandomGenerator& rng);
/// A panel of pillars behind one tunnel.
PlanDescription room_and_pillar(double length_m, RandomGenerator& rng);
/// A tunnel with branches to both sides, which branch again.
PlanDescription branching(double length_m, RandomGenerator& rng);
/// A loop, and a tunnel across it.
PlanDescription ring(double length_m, RandomGenerator& rng);

// Shared by the topologies.

/// A line of the given length with small random bends about its direction.
std::vector<Eigen::Vector2d> wandering_line(const Eigen::Vector2d& from, double heading_rad,
                                            double length_m, RandomGenerator& rng);

/// The tunnel along a line.
TunnelDescription tunnel_along(const std::string& name, const std::vector<Eigen::Vector2d>& line,
                               double width_m);

/// `main`, from the origin along x, straight for `kUndamagedLength`, with random bends beyond.
TunnelDescription main_tunnel(double length_m, RandomGenerator& rng);

}  // namespace adit
