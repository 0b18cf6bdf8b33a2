// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "sim/world/build_world.hpp"
#include "tests/support/worlds/planar_mine.hpp"

namespace adit {

using Tunnel = std::vector<double>;  ///< x, y, x, y, ... of its centre line

/// A mine of tunnels, 3 m wide, with walls as rough as in the simulator. The first tunnel begins at
/// the origin and is open there; the robot starts 3 m from it and faces along x.
inline World tunnel_world(const std::vector<Tunnel>& tunnels, double width_m = 3.0, int seed = 1) {
  WorldDescription description;
  description.name = "tunnels";
  description.seed = seed;
  description.T_world_start = {3.0, 0.0, 0.0};
  for (const Tunnel& points : tunnels) {
    const bool first = description.plan.tunnels.empty();
    description.plan.tunnels.push_back(
        {"tunnel_" + std::to_string(description.plan.tunnels.size()), points, width_m, first});
  }
  return build_world(description);
}

inline test::PlanarMine tunnel_mine(const std::vector<Tunnel>& tunnels, double width_m = 3.0,
                                    int seed = 1) {
  return test::planar_mine(tunnel_world(tunnels, width_m, seed));
}

inline const std::vector<Tunnel>& straight() {
  static const std::vector<Tunnel> tunnels{{0, 0, 40, 0}};
  return tunnels;
}
inline const std::vector<Tunnel>& junction() {  // a T of arms of 20 m
  static const std::vector<Tunnel> tunnels{{0, 0, 25, 0}, {25, -20, 25, 20}};
  return tunnels;
}
inline const std::vector<Tunnel>& crossroads() {
  static const std::vector<Tunnel> tunnels{{0, 0, 45, 0}, {25, -20, 25, 20}};
  return tunnels;
}
inline const std::vector<Tunnel>& ring() {  // 20 m by 20 m behind an entry of 10 m
  static const std::vector<Tunnel> tunnels{{0, 0, 10, 0},
                                           {10, -10, 30, -10, 30, 10, 10, 10, 10, -10}};
  return tunnels;
}
inline const std::vector<Tunnel>& rooms_and_pillars() {  // pillars of 9 m by 9 m
  static const std::vector<Tunnel> tunnels{{0, 0, 46, 0},   {10, 12, 46, 12}, {10, 24, 46, 24},
                                           {10, 0, 10, 24}, {22, 0, 22, 24},  {34, 0, 34, 24},
                                           {46, 0, 46, 24}};
  return tunnels;
}

}  // namespace adit
