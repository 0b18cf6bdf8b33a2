// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/mission/mission_preparation.hpp"

#include <string>

#include "common/files/text_file.hpp"
#include "sim/live/fault_text.hpp"
#include "sim/world/build_world.hpp"
#include "sim/world/world_file.hpp"
#include "tools/mission/mission_files.hpp"

namespace adit {
namespace {

constexpr std::int64_t kAfterCutUs = 10'000'000;  // of simulated time

Eigen::Vector2d begin(const MissionLiveOptions& options, const MissionFolder& folder) {
  folder.require_new();
  const WorldDescription world = describe(options.world);
  build_world(world);  // what cannot be built is said here, and not by a process that ends
  write_text(mission_config(options.config), folder.config());
  write_text(to_world_file(world), folder.world());
  write_text(to_world_file(world), folder.start());
  write_text(mission_supervisor(), folder.path() / "supervisor.yaml");
  return world.T_world_start.translation();
}

/// Returns where it once began, and says when the new life does.
Eigen::Vector2d go_on(const MissionFolder& folder, SimulatorStart& start) {
  folder.require_unfinished();
  WorldDescription world = find_world(folder.world().string());
  Eigen::Vector2d p_world_start = world.T_world_start.translation();
  const MissionStand stand = folder.last_stand();
  world.T_world_start = stand.T_world_body;
  start.start_utime = stand.utime + kAfterCutUs;
  write_text(to_world_file(world), folder.start());
  return p_world_start;
}

}  // namespace

Eigen::Vector2d prepare_mission(const MissionLiveOptions& options, const MissionFolder& folder) {
  for (const std::string& fault : options.faults) parse_fault(fault);
  SimulatorStart start{folder.next_log(), std::nullopt, options.speed, options.faults};
  Eigen::Vector2d p_world_start = options.resume ? go_on(folder, start) : begin(options, folder);
  write_text(mission_processes(start), folder.path() / "processes.cfg");
  return p_world_start;
}

}  // namespace adit
