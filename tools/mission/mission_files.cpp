// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/mission/mission_files.hpp"

#include <set>
#include <sstream>
#include <string>

#include <fmt/format.h>

#include "common/bus/node/stages.hpp"
#include "common/config/config.hpp"
#include "common/files/file_utils.hpp"
#include "sim/live/fault_parser.hpp"
#include "sim/live/sim_config.hpp"
#include "sim/simulation/simulation.hpp"
#include "sim/world/build_world.hpp"
#include "sim/world/world_file.hpp"
#include "tools/mission/pipeline.hpp"

namespace adit {
namespace {

// Pose and commands expire after 0.25 s and take two cycles from the simulator to the guard.
constexpr const char* kAheadMax = " --ahead-max-s 0.1";

// The supervisor of a robot detects a dead or hanging process within this time. At maximum speed,
// minutes of simulated time would pass until then.
constexpr const char* kOutageMax = " --outage-max-s 10";

constexpr const char* kLicence =
    "# SPDX-FileCopyrightText: The Adit authors\n# SPDX-License-Identifier: BSD-3-Clause\n";

/// Quotes an argument for a command line within the double quotes of a process list.
std::string quoted(const std::string& argument) { return "'" + argument + "'"; }

std::string simulator_line(const SimulatorStart& start) {
  std::string names;
  for (const std::string& stage : stage_names()) names += (names.empty() ? "" : ",") + stage;
  std::string line = "adit-sim start.yaml --config mission.yaml --speed " + start.speed +
                     kAheadMax + kOutageMax + " --wait-for " + names + " --record " +
                     start.log.filename().string();
  if (start.start_utime) line += " --start-utime " + std::to_string(*start.start_utime);
  for (const std::string& fault : start.faults) line += " --fault " + quoted(fault);
  return line;
}

}  // namespace

std::string without_repeated_sections(const std::vector<std::string>& yamls) {
  std::set<std::string> sections;
  std::string text;
  for (const std::string& yaml : yamls) {
    bool repeated = false;
    std::istringstream lines(yaml);
    for (std::string line; std::getline(lines, line);) {
      const bool is_key = !line.empty() && line.front() != ' ' && line.front() != '#';
      if (is_key) repeated = !sections.insert(line.substr(0, line.find(':'))).second;
      if (!repeated) text += line + "\n";
    }
  }
  return text;
}

std::string mission_config(const std::filesystem::path& config) {
  const SimulationParams params = load_simulation_params(config, {});
  std::vector<std::string> yamls;
  for (const ConfiguredNode& node :
       configure_pipeline(load_config(config), params.lasers, params.vehicle, "")) {
    yamls.push_back(node.yaml);
  }
  yamls.push_back(to_yaml(params, kSimSection));
  return without_repeated_sections(yamls);
}

/// The list has no heartbeat timeouts: all processes stand still while the simulator does.
std::string process_list_text(const SimulatorStart& start) {
  std::string text = fmt::format(R"({}group "simulation" {{
  cmd "sim" {{
    exec = "{}";
    stop_signal = 15; stop_time_allowed = 20;
  }}
}}
group "stages" {{
)",
                                 kLicence, simulator_line(start));
  for (const std::string& stage : stage_names()) {
    if (stage == "supervisor") continue;  // it manages the others
    text += fmt::format(R"(  cmd "{0}" {{
    exec = "adit-{0} --sim-time --config mission.yaml";
    auto_respawn = "true"; stop_signal = 15; stop_time_allowed = 3;
  }}
)",
                        stage);
  }
  return text + R"(}
script "start_all" {
  start group "stages";
  start cmd "sim";
}
)";
}

std::string supervisor_config() {
  return std::string(kLicence) +
         "supervisor:\n  processes: processes.cfg\n  deputy_id: mission\n  start_script: "
         "start_all\n"
         "  socket: ./supervisor.sock\n";
}

namespace {

constexpr std::int64_t kPowerLossDurationUs = 10'000'000;  // of simulated time

Eigen::Vector2d start_mission(const MissionLiveOptions& options, const MissionFolder& folder) {
  folder.require_new();
  const WorldDescription world = describe(options.world);
  build_world(world);  // reports errors of the world here, not in the process of the simulator
  write_text_file(mission_config(options.config), folder.config());
  write_text_file(to_world_file(world), folder.world());
  write_text_file(to_world_file(world), folder.start());
  write_text_file(supervisor_config(), folder.path() / "supervisor.yaml");
  return world.T_world_start.translation();
}

/// Returns the position of the first start. Sets the start time of the new run.
Eigen::Vector2d resume_mission(const MissionFolder& folder, SimulatorStart& start) {
  folder.require_unfinished();
  WorldDescription world = find_world(folder.world().string());
  Eigen::Vector2d p_world_start = world.T_world_start.translation();
  const SimulatedPose pose = folder.last_pose();
  world.T_world_start = pose.T_world_body;
  start.start_utime = pose.utime + kPowerLossDurationUs;
  write_text_file(to_world_file(world), folder.start());
  return p_world_start;
}

}  // namespace

Eigen::Vector2d prepare_mission(const MissionLiveOptions& options, const MissionFolder& folder) {
  for (const std::string& fault : options.faults) parse_fault(fault);
  SimulatorStart start{folder.next_log(), std::nullopt, options.speed, options.faults};
  Eigen::Vector2d p_world_start =
      options.resume ? resume_mission(folder, start) : start_mission(options, folder);
  write_text_file(process_list_text(start), folder.path() / "processes.cfg");
  return p_world_start;
}

}  // namespace adit
