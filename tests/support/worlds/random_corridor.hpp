// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/geometry/pose2.hpp"
#include "common/types/vehicle.hpp"
#include "sim/mesh/mesh_builder.hpp"
#include "sim/world/plan/tunnel_line.hpp"
#include "sim/world/world.hpp"
#include "sim/world/world_description.hpp"

namespace adit {

/// Adds objects to a built world that a WorldDescription cannot express.
using AddObjects = std::function<void(MeshBuilder&, const World&)>;

/// Adds objects to a built world.
void add_objects(World& world, const AddObjects& add);

/// Adds a cable from `from` to `to`, both in world, that sags by `sag_m` in the middle.
void add_cable(MeshBuilder& builder, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
               double sag_m, double diameter_m);

/// A box with the axes of `T_world_plan`, tilted by `tilt_rad` about x, with its centre at the
/// height `middle_m`.
OrientedBox plan_box(const Pose2& T_world_plan, double middle_m, const Eigen::Vector3d& size,
                     double tilt_rad = 0.0);

/// A rough, bent tunnel named `main` of 26 m, in which a robot stands 6 m from the start and faces
/// along the tunnel.
struct RandomCorridorMine {
  std::string kind;  ///< of the obstacles
  WorldDescription description;
  std::vector<AddObjects> objects;
  double across_m = 0.0;     ///< of the robot, to the left of the centre line
  double heading_rad = 0.0;  ///< of the robot, relative to the tunnel
};

/// Position of the robot along `main` [m].
inline constexpr double kCorridorStart = 6.0;

/// The kinds of obstacles. Each random corridor has one kind, and random additional objects.
const std::vector<std::string>& corridor_kinds();

/// A random mine; deterministic for a seed. `kind` is one of corridor_kinds().
RandomCorridorMine random_corridor_mine(int seed, const std::string& kind);

/// A built RandomCorridorMine with a robot.
struct Corridor {
  std::string kind;
  TunnelLine tunnel;
  std::unique_ptr<Site> site;
  Pose2 T_world_robot;
  Eigen::Isometry3d T_world_body;  ///< of the robot standing on its wheels
  double direction_rad = 0.0;      ///< to the point of the tunnel 8 m ahead, in world
};

/// Throws std::invalid_argument if the robot cannot stand at its start.
Corridor build_corridor(const RandomCorridorMine& mine);

/// The first mine of a seed in which the vehicle stands with `room_m` of free space on all sides.
/// Successive seeds cycle through the kinds.
Corridor random_corridor_with_robot(int seed, const Vehicle& vehicle = {}, double room_m = 0.15);

}  // namespace adit
