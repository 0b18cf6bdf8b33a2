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

/// What no description of a world has: hung up, laid or thrown into a tunnel by hand.
using AddObjects = std::function<void(MeshBuilder&, const World&)>;

/// Puts things into a world that is built.
void add_objects(World& world, const AddObjects& add);

/// A cable from `from` to `to`, both in world, that hangs `sag_m` below the line between them in
/// its middle.
void add_cable(MeshBuilder& builder, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
               double sag_m, double diameter_m);

/// A box, the axes of which are those of `T_world_plan`, turned by `tilt_rad` about its x.
OrientedBox plan_box(const Pose2& T_world_plan, double middle_m, const Eigen::Vector3d& size,
                     double tilt_rad = 0.0);

/// A rough tunnel named `main`, bent and 26 m long, in which a robot stands 6 m from its beginning
/// and looks along it.
struct RandomCorridorMine {
  std::string kind;  ///< what is in it
  WorldDescription description;
  std::vector<AddObjects> objects;
  double across_m = 0.0;     ///< of the robot, to the left of the middle
  double heading_rad = 0.0;  ///< of the robot, against the tunnel
};

/// Where the robot stands in `main` [m].
inline constexpr double kCorridorStart = 6.0;

/// What random corridors have in them, one kind each, and whatever else chance adds.
const std::vector<std::string>& corridor_kinds();

/// The same seed makes the same mine. `kind` is one of the kinds.
RandomCorridorMine random_corridor_mine(int seed, const std::string& kind);

/// A mine that is built, with a robot in it.
struct Corridor {
  std::string kind;
  TunnelLine tunnel;
  std::unique_ptr<Site> site;
  Pose2 T_world_robot;
  Eigen::Isometry3d T_world_body;  ///< as its wheels hold it
  double direction_rad = 0.0;      ///< to where the tunnel is 8 m ahead, in world
};

/// Throws std::invalid_argument where the robot cannot stand.
Corridor build_corridor(const RandomCorridorMine& mine);

/// Kinds by turns; of one seed the first mine in which the vehicle stands, free all round by
/// `room_m`.
Corridor random_corridor_with_robot(int seed, const Vehicle& vehicle = {}, double room_m = 0.15);

}  // namespace adit
