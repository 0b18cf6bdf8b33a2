// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/mission/mission_folder.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "common/bus/channels.hpp"
#include "common/bus/log/event_source.hpp"
#include "common/bus/node/stages.hpp"
#include "common/config/config.hpp"
#include "common/files/file_utils.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "procs/mapping/map_journal.hpp"
#include "procs/mission/mission_journal.hpp"
#include "sim/live/sim_config.hpp"
#include "sim/simulation/simulation.hpp"
#include "sim/world/build_world.hpp"
#include "sim/world/world_file.hpp"
#include "tools/mission/pipeline.hpp"

namespace adit {
namespace {

namespace fs = std::filesystem;

// Pose and commands expire after 0.25 s and take two cycles from the simulator to the guard.
constexpr const char* kAheadMax = "--ahead-max-s 0.1";

// The supervisor of a robot detects a dead or hanging process within this time. At maximum speed,
// minutes of simulated time would pass until then.
constexpr const char* kOutageMax = "--outage-max-s 10";

constexpr const char* kLicence =
    "# SPDX-FileCopyrightText: The Adit authors\n# SPDX-License-Identifier: BSD-3-Clause\n";

fs::path log_of_run(const fs::path& folder, int run_number) {
  return plain_or_compressed(
      folder / (run_number == 1 ? "run.lcmlog" : fmt::format("run_{}.lcmlog", run_number)));
}

std::optional<SimulatedPose> truth_pose_in(const LogEventView& event) {
  if (event.channel != channels::kTruth) return std::nullopt;
  const auto message = decode<pose_t>(event.data);
  if (!message) return std::nullopt;
  const auto pose = from_message(*message);  // TRUTH: T_world_body
  if (!pose) return std::nullopt;
  return SimulatedPose{pose->utime, pose->T_odom_body, pose->z_m};
}

std::optional<SimulatedPose> last_truth_pose_in(const fs::path& log) {
  LogReader reader(log);
  std::optional<SimulatedPose> last;
  std::int64_t last_utime = std::numeric_limits<std::int64_t>::min();
  while (const auto event = reader.next()) {
    if (event->utime < last_utime) continue;
    const auto pose = truth_pose_in(*event);
    if (!pose) continue;
    last = pose;
    last_utime = event->utime;
  }
  return last;
}

/// Start options of the simulator of a mission.
struct SimulatorStart {
  fs::path log;                             ///< file to record
  std::optional<std::int64_t> start_utime;  ///< of simulated time; nothing: the wall clock
  std::string speed = "max";                ///< value of `adit sim --speed`
  std::vector<std::string> faults;          ///< in the syntax of parse_fault
};

std::string simulator_line(const SimulatorStart& start) {
  std::string line = fmt::format(
      "adit-sim start.yaml --config mission.yaml --speed {} {} {} --wait-for {} --record {}",
      start.speed, kAheadMax, kOutageMax, fmt::join(stage_names(), ","),
      start.log.filename().string());
  if (start.start_utime) line += fmt::format(" --start-utime {}", *start.start_utime);
  // In single quotes, as the line is within the double quotes of a process list.
  for (const std::string& fault : start.faults) line += fmt::format(" --fault '{}'", fault);
  return line;
}

/// The process list: the stages, and the simulator, which waits for all stages and records. It has
/// no heartbeat timeouts: all processes stand still while the simulator does.
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

/// YAML for adit-supervisor.
std::string supervisor_config() {
  return fmt::format(R"({}supervisor:
  processes: processes.cfg
  deputy_id: mission
  start_script: start_all
  socket: ./supervisor.sock
)",
                     kLicence);
}

MissionStart start_mission(const MissionLiveOptions& options, const MissionFolder& folder) {
  folder.require_new();
  const SimulationParams params = load_simulation_params(options.config, {});
  const WorldDescription world = describe(options.world, params.vehicle);
  build_world(world);  // reports errors of the world here, not in the process of the simulator
  write_text_file(mission_config(options.config), folder.config());
  write_text_file(to_world_file(world), folder.world());
  write_text_file(to_world_file(world), folder.start());
  write_text_file(supervisor_config(), folder.path() / "supervisor.yaml");
  return {world.T_world_start.translation(), std::nullopt};
}

/// The level of the tunnels in which a robot is. Builds the world if there are several.
int level_of(const WorldDescription& description, const SimulatedPose& pose) {
  const auto& tunnels = description.plan.tunnels;
  const bool one = std::all_of(tunnels.begin(), tunnels.end(), [&](const TunnelDescription& t) {
    return t.level == tunnels.front().level;
  });
  if (one) return description.start_level;
  return build_world(description)
      .truth.level_at({pose.T_world_body.x, pose.T_world_body.y, pose.z_m});
}

/// Returns the first start. Sets the start time of the new run.
MissionStart resume_mission(const MissionFolder& folder, SimulatorStart& start) {
  folder.require_unfinished();
  WorldDescription world = find_world(folder.world().string());
  MissionStart first{world.T_world_start.translation(), folder.start_height_m()};
  const SimulatedPose pose = folder.last_pose();
  start.start_utime = pose.utime + kPowerLossDurationUs;
  write_text_file(to_world_file(with_start_at(std::move(world), pose)), folder.start());
  return first;
}

}  // namespace

MissionFolder::MissionFolder(const fs::path& path) {
  fs::create_directories(path);
  path_ = fs::canonical(path);
}

std::vector<fs::path> MissionFolder::logs() const {
  std::vector<fs::path> found;
  for (int run_number = 1; fs::exists(log_of_run(path_, run_number)); ++run_number) {
    found.push_back(log_of_run(path_, run_number));
  }
  return found;
}

fs::path MissionFolder::next_log(LogForm form) const {
  const fs::path log = log_of_run(path_, static_cast<int>(logs().size()) + 1);
  return form == LogForm::kCompressed ? compressed_name(log) : log;
}

bool MissionFolder::has_mission() const { return fs::exists(journal()) || !logs().empty(); }

void MissionFolder::require_new() const {
  if (!has_mission()) return;
  throw std::runtime_error(fmt::format(
      "{} already has a mission: resume it with --resume, or use another folder", path_.string()));
}

void MissionFolder::require_unfinished() const {
  if (!has_mission() || !fs::exists(world()) || !fs::exists(config())) {
    throw std::runtime_error(fmt::format("{} has no mission to resume", path_.string()));
  }
  if (!fs::exists(journal())) return;  // power loss before the first phase
  const std::optional<MissionPhase> last = read_last_phase(journal());
  if (last && last->phase == Phase::kEnded) {
    throw std::runtime_error(
        fmt::format("the mission in {} has ended: {}", path_.string(), last->reason));
  }
}

SimulatedPose MissionFolder::last_pose() const {
  const std::vector<fs::path> logs = this->logs();
  for (auto log = logs.rbegin(); log != logs.rend(); ++log) {
    if (const auto pose = last_truth_pose_in(*log)) return *pose;
  }
  throw std::runtime_error(
      fmt::format("{}: no log has TRUTH, the pose to resume from is unknown", path_.string()));
}

std::optional<double> MissionFolder::start_height_m() const {
  const std::vector<fs::path> logs = this->logs();
  if (logs.empty()) return std::nullopt;
  LogReader log(logs.front());
  while (const auto event = log.next()) {
    if (const auto pose = truth_pose_in(*event)) return pose->z_m;
  }
  return std::nullopt;
}

namespace {

/// A journal that ends earlier than it did is intact by itself; the mission knows what the map had.
std::string map_end_report(const MissionFolder& folder) {
  const fs::path map = folder.path() / "mapping.journal";
  if (!fs::exists(folder.journal()) || !fs::exists(map)) return {};
  const std::optional<int> newest = read_newest_local_map(folder.journal());
  const auto maps = static_cast<int>(read_map_journal(map).maps.size());
  if (!newest || *newest < maps) return {};
  return fmt::format("mapping.journal: local maps {} to {} lost, which the mission had", maps,
                     *newest);
}

}  // namespace

WorldDescription with_start_at(WorldDescription world, const SimulatedPose& pose) {
  world.start_level = level_of(world, pose);
  world.T_world_start = pose.T_world_body;
  return world;
}

std::vector<std::string> journal_reports(const MissionFolder& folder) {
  constexpr const char* kSuffix = ".journal";
  constexpr const char* kMapping = "mapping";
  std::vector<std::string> reports;
  for (const std::string& stage : stage_names()) {
    const fs::path path = folder.path() / (stage + kSuffix);
    if (!fs::exists(path) && !fs::exists(journal_copy(path))) continue;
    const std::string report =
        stage == kMapping ? map_journal_report(path, read_map_journal(path))
                          : journal_report(path, read_journal(path, [](const JournalRecord&) {}));
    if (!report.empty()) reports.push_back(report);
  }
  if (const std::string report = map_end_report(folder); !report.empty()) reports.push_back(report);
  return reports;
}

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

MissionStart prepare_mission(const MissionLiveOptions& options, const MissionFolder& folder) {
  for (const std::string& fault : options.faults) parse_fault(fault);
  SimulatorStart start{folder.next_log(options.log_form), std::nullopt, options.speed,
                       options.faults};
  MissionStart first =
      options.resume ? resume_mission(folder, start) : start_mission(options, folder);
  write_text_file(process_list_text(start), folder.path() / "processes.cfg");
  return first;
}

}  // namespace adit
