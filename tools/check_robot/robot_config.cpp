// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/check_robot/robot_config.hpp"

#include "common/bus/node/stages.hpp"
#include "common/config/config.hpp"

namespace adit {

RobotConfig load_robot_config(const ConfigFile& file) {
  file.require_known_sections(config_sections());
  RobotConfig robot;
  robot.lasers = load_section<Lasers>(file, Lasers::kSection);
  robot.vehicle = load_section<Vehicle>(file, Vehicle::kSection);
  robot.guard = load_section<GuardParams>(file, "guard");
  robot.driving = load_section<DrivingParams>(file, "driving");
  robot.planning = load_section<PlanningParams>(file, "planning");
  robot.terrain = load_section<TerrainParams>(file, "terrain");
  robot.scan_assembly = load_section<ScanAssemblyNodeParams>(file, "scan_assembly");
  robot.scan_matching = load_section<ScanMatchingParams>(file, "scan_matching");
  robot.exploration = load_section<ExplorationNodeParams>(file, "exploration");
  robot.mission = load_section<MissionNodeParams>(file, "mission");
  robot.sim = load_section<SimulationParams>(file, kSimSection);
  robot.has_lasers = file.section(Lasers::kSection) != nullptr;
  robot.has_sim = file.section(kSimSection) != nullptr;
  return robot;
}

}  // namespace adit
