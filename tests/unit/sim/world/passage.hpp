// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/world/plan/tunnel_line.hpp"
#include "sim/world/world.hpp"

namespace adit {

/// A level box that keeps `belly_m` above the floor at its centre.
struct Body {
  double length_m = 2.4;
  double width_m = 1.2;
  double height_m = 1.0;
  double belly_m = 0.3;
};

/// Whether a body is free of collisions at a pose of the plan.
bool is_free(const Site& site, const Body& body, const Pose2& T_world_body);

/// Whether a body can move between two positions of a tunnel within it, by small steps along,
/// across and of heading, independent of its steering.
bool is_passable(const Site& site, const Body& body, const TunnelLine& tunnel, double from_m,
                 double to_m);

}  // namespace adit
