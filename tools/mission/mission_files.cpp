// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/mission/mission_files.hpp"

#include <set>
#include <sstream>
#include <string>

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

// Pose and commands expire after 0.25 s, and take two turns from the simulator to who judges them.
constexpr const char* kAhead = " --ahead-max-s 0.1";

// A supervisor of a robot sees within this time that a process has gone or stands still; as fast as
// it goes, minutes of simulated time would go by until it does.
constexpr const char* kMissed = " --outage-max-s 10";

constexpr const char* kLicence =
    "# SPDX-FileCopyrightText: The Adit authors\n# SPDX-License-Identifier: BSD-3-Clause\n";

/// For a shell's reader, within the double quotes of a process list.
std::string quoted(const std::string& word) { return "'" + word + "'"; }

std::string simulator_line(const SimulatorStart& start) {
  std::string names;
  for (const std::string& stage : stage_names()) names += (names.empty() ? "" : ",") + stage;
  std::string line = "adit-sim start.yaml --config mission.yaml --speed " + start.speed + kAhead +
                     kMissed + " --wait-for " + names + " --record " +
                     start.log.filename().string();
  if (start.start_utime) line += " --start-utime " + std::to_string(*start.start_utime);
  for (const std::string& fault : start.faults) line += " --fault " + quoted(fault);
  return line;
}

}  // namespace

std::string without_repeated_sections(const std::vector<std::string>& yamls) {
  std::set<std::string> seen;
  std::string text;
  for (const std::string& yaml : yamls) {
    bool repeated = false;
    std::istringstream lines(yaml);
    for (std::string line; std::getline(lines, line);) {
      const bool is_key = !line.empty() && line.front() != ' ' && line.front() != '#';
      if (is_key) repeated = !seen.insert(line.substr(0, line.find(':'))).second;
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

/// No sign of life is asked for: the simulator may stand still, and everybody with it.
std::string process_list_text(const SimulatorStart& start) {
  std::string text = kLicence;
  text += "group \"simulation\" {\n  cmd \"sim\" {\n    exec = \"" + simulator_line(start) +
          "\";\n    stop_signal = 15; stop_time_allowed = 20;\n  }\n}\ngroup \"stages\" {\n";
  for (const std::string& stage : stage_names()) {
    if (stage == "supervisor") continue;  // which keeps them
    text.append("  cmd \"").append(stage).append("\" {\n    exec = \"adit-").append(stage);
    text.append(" --sim-time --config mission.yaml\";\n    auto_respawn = \"true\"; ");
    text.append("stop_signal = 15; stop_time_allowed = 3;\n  }\n");
  }
  text += "}\nscript \"go\" {\n  start group \"stages\";\n  start cmd \"sim\";\n}\n";
  return text;
}

std::string supervisor_config() {
  return std::string(kLicence) +
         "supervisor:\n  processes: processes.cfg\n  deputy_id: mission\n  start_script: go\n"
         "  socket: ./supervisor.sock\n";
}

namespace {

constexpr std::int64_t kPowerLossDurationUs = 10'000'000;  // of simulated time

Eigen::Vector2d start_mission(const MissionLiveOptions& options, const MissionFolder& folder) {
  folder.require_new();
  const WorldDescription world = describe(options.world);
  build_world(world);  // what cannot be built is said here, and not by a process that ends
  write_text_file(mission_config(options.config), folder.config());
  write_text_file(to_world_file(world), folder.world());
  write_text_file(to_world_file(world), folder.start());
  write_text_file(supervisor_config(), folder.path() / "supervisor.yaml");
  return world.T_world_start.translation();
}

/// Returns where it once began, and says when the new life does.
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
