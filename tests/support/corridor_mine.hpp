// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/geometry/pose2.hpp"
#include "common/vehicle/vehicle.hpp"
#include "sim/world/drift_line.hpp"
#include "sim/world/world.hpp"
#include "sim/world/world_description.hpp"
#include "tests/support/loose_things.hpp"

namespace adit {

/// A rough drift named `main`, bent and 26 m long, in which a robot stands 6 m from its beginning
/// and looks along it.
struct CorridorMine {
  std::string kind;  ///< what is in it
  WorldDescription description;
  std::vector<AddThings> things;
  double across_m = 0.0;     ///< of the robot, to the left of the middle
  double heading_rad = 0.0;  ///< of the robot, against the drift
};

/// Where the robot stands in `main` [m].
inline constexpr double kCorridorStart = 6.0;

/// What random corridors have in them, one kind each, and whatever else chance adds.
const std::vector<std::string>& corridor_kinds();

/// The same seed makes the same mine. `kind` is one of the kinds.
CorridorMine random_corridor_mine(int seed, const std::string& kind);

/// A mine that is built, with a robot in it.
struct Corridor {
  std::string kind;
  DriftLine drift;
  std::unique_ptr<Site> site;
  Pose2 T_world_robot;
  Eigen::Isometry3d T_world_body;  ///< as its wheels hold it
  double direction_rad = 0.0;      ///< to where the drift is 8 m ahead, in world
};

/// Throws std::invalid_argument where the robot cannot stand.
Corridor build_corridor(const CorridorMine& mine);

/// Kinds by turns; of one seed the first mine in which the vehicle stands, free all round by
/// `room_m`.
Corridor random_corridor_with_robot(int seed, const Vehicle& vehicle = {}, double room_m = 0.15);

}  // namespace adit
