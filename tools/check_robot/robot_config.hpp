// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/config/config_file.hpp"
#include "common/sensing/laser_mount.hpp"
#include "common/types/vehicle.hpp"
#include "procs/driving/driving.hpp"
#include "procs/exploration/exploration_node.hpp"
#include "procs/guard/guard_params.hpp"
#include "procs/mission/mission_node.hpp"
#include "procs/planning/planning.hpp"
#include "procs/scan_assembly/scan_assembly_node.hpp"
#include "procs/scan_matching/scan_matching.hpp"
#include "procs/terrain/terrain_params.hpp"
#include "sim/simulation/simulation_params.hpp"

namespace adit {

/// The parameters of a robot as the stages load them, whose relations are checked.
struct RobotConfig {
  Lasers lasers;
  Vehicle vehicle;
  GuardParams guard;
  DrivingParams driving;
  PlanningParams planning;
  TerrainParams terrain;
  ScanAssemblyNodeParams scan_assembly;
  ScanMatchingParams scan_matching;
  ExplorationNodeParams exploration;
  MissionNodeParams mission;
  SimulationParams sim;
  bool has_lasers = false;  ///< whether the file describes them
  bool has_sim = false;     ///< whether the file has a section for the simulator
};

/// Throws ConfigError, as the stages do.
RobotConfig load_robot_config(const ConfigFile& file);

}  // namespace adit
