// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "tools/sample_mine/synthetic_world.hpp"

namespace adit {

/// A straight, smooth drift along x, centred on the origin, open at both ends: long enough, nothing
/// in it tells a laser how far along it stands.
SyntheticWorld straight_tunnel(double length_m, double width_m);

/// A small abandoned mine, about 120 m by 80 m: an adit that leads from the portal at the origin
/// into a ring of 215 m, a cross-cut through a room that stands on pillars, and dead ends. The plan
/// is always the same; the rough walls and the pillars come from the seed.
SyntheticWorld sample_mine(std::uint64_t seed);

/// A way through any sample mine that closes two loops and ends where it began: about 450 m.
std::vector<Eigen::Vector2d> sample_mine_route();

}  // namespace adit
