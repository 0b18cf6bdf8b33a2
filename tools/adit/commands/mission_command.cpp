// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <unistd.h>

#include "tools/adit/adit_app.hpp"
#include "tools/adit/commands/report_command.hpp"
#include "tools/mission/mission_folder.hpp"
#include "tools/mission/mission_live.hpp"
#include "tools/mission/mission_progress.hpp"
#include "tools/mission/mission_run.hpp"

namespace adit {
namespace {

/// Shows how a mission goes: on a terminal one line that changes, in a file a line now and then.
class MissionProgressPrinter {
 public:
  MissionProgressPrinter();

  /// `wall_s` is the time since the mission began.
  void update(const MissionProgress& progress, double wall_s);
  /// What a person should know, on standard error.
  void print_message(const std::string& what) const;
  /// How it ended, and how long that took. `trouble` is why it did not come to its end, or empty.
  static void end(const MissionProgress& last, const std::string& abort_reason, double wall_s);

 private:
  bool is_terminal_;
  double next_s_ = 0.0;
};

constexpr double kLinePeriodS = 10.0;

MissionProgressPrinter::MissionProgressPrinter() : is_terminal_(isatty(STDOUT_FILENO) == 1) {}

void MissionProgressPrinter::update(const MissionProgress& progress, double wall_s) {
  const double factor = wall_s > 0.0 ? progress.simulated_s / wall_s : 0.0;
  if (is_terminal_) {
    std::printf("\r%s ", progress_text(progress, factor).c_str());
  } else if (wall_s >= next_s_) {
    std::printf("%s\n", progress_text(progress, factor).c_str());
    next_s_ = wall_s + kLinePeriodS;
  }
  std::fflush(stdout);
}

void MissionProgressPrinter::print_message(const std::string& what) const {
  if (is_terminal_) std::printf("\n");
  std::fflush(stdout);
  std::cerr << "adit mission: " << what << std::endl;
}

void MissionProgressPrinter::end(const MissionProgress& last, const std::string& abort_reason,
                                 double wall_s) {
  std::printf("\n%s\n%.0f s of simulated time in %.0f s; %.2f m from the start at the end\n",
              abort_reason.empty() ? last.phase.reason.c_str() : abort_reason.c_str(),
              last.simulated_s, wall_s, last.distance_from_start_m);
  std::fflush(stdout);
}

constexpr int kExitNotReturned = 1;

struct MissionOptions {
  MissionLiveOptions mission;
  bool in_process = false;
};

constexpr const char* kMissionFooter =
    R"(Sends a robot into a simulated mine: it explores, scans, plans and drives by itself, and comes home. Each
stage is a process of its own, kept running by an adit-supervisor, on a network of their own; with
--in-process all are in this one, with the same log each time. Exit code 0 when the robot is at home, 1
when it is not.

The folder then holds the report of adit report, mission.html with map and figures and the files that belong
to it; run.lcmlog with all that was said, phases.tsv with what the robot was at and why, the journals from
which it can go on, and the configuration of all processes. While it runs:
  adit ps --socket DIR/supervisor.sock          its processes; adit logs NAME and adit restart NAME, too
  adit order return --mission DIR            what a person may order

Faults are those of adit sim; a process that is killed or suspended is started again.

Examples:
  adit mission mathies --out mission
  adit mission random --seed 7 --length-m 60 --out mission --fault kill:mapping@100
  adit mission --out mission --resume           after it was interrupted, or all of it was cut off
  adit mission mathies --in-process --out mission)";

/// Makes the folder of the mission from its logs, also of one that did not come home. What stops
/// that is said, and changes nothing of how the mission ended. A life that was cut off at once has
/// left an empty log.
void report(const std::filesystem::path& folder) try {
  const MissionFolder mission(folder);
  std::vector<std::filesystem::path> logs = mission.logs();
  std::erase_if(logs, [](const auto& log) { return std::filesystem::file_size(log) == 0; });
  print_report({logs, mission.path()});
} catch (const std::exception& error) {
  std::fprintf(stderr, "adit mission: there is no report: %s\n", error.what());
}

/// Throws the exit code of a mission that did not come home.
void require_return(const MissionProgress& last, const std::string& abort_reason) {
  const bool home = abort_reason.empty() && last.phase.outcome == MissionOutcome::kHome;
  if (!home) throw CLI::RuntimeError(kExitNotReturned);
}

void run_in_process(const MissionLiveOptions& mission) {
  if (mission.resume) throw std::invalid_argument("--resume is for a mission of processes");
  MissionFolder(mission.folder).require_new();
  MissionRunOptions options;
  options.world = mission.world;
  options.folder = mission.folder;
  options.config = mission.config;
  options.faults = mission.faults;
  options.time_max_s = mission.time_max_s;
  MissionProgressPrinter printer;
  const auto begin = std::chrono::steady_clock::now();
  const MissionRunResult result = run_mission(options, [&](const MissionProgress& progress) {
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
    printer.update(progress, wall.count());
  });
  const bool ended = result.last.phase.phase == Phase::kEnded;
  const std::string abort_reason = !result.failure.empty() ? "the run has failed: " + result.failure
                                   : ended                 ? ""
                                                           : "its time is up";
  MissionProgressPrinter::end(result.last, abort_reason, result.wall_s);
  report(mission.folder);
  require_return(result.last, abort_reason);
}

void run_processes(const MissionLiveOptions& mission) {
  const std::filesystem::path folder = std::filesystem::absolute(mission.folder);
  MissionProgressPrinter printer;
  const MissionLiveResult result = run_live_mission(
      mission,
      [&](const MissionProgress& progress, double wall_s) { printer.update(progress, wall_s); },
      [&](const std::string& what) { printer.print_message(what); });
  MissionProgressPrinter::end(result.last, result.abort_reason, result.wall_s);
  if (!result.interrupted) report(folder);
  require_return(result.last, result.abort_reason);
}

void run(const MissionOptions& options) {
  if (options.mission.world.name.empty() == !options.mission.resume) {
    throw std::invalid_argument(
        "say in which mine, or --resume to go on with the mission of --out");
  }
  if (options.in_process) return run_in_process(options.mission);
  run_processes(options.mission);
}

void add_options(CLI::App& command, MissionOptions& options) {
  MissionLiveOptions& mission = options.mission;
  CLI::Option* world = add_world_options(command, mission.world);
  command.add_option("--world", mission.world.name, "The same as WORLD")->excludes(world);
  command.add_option("--out", mission.folder, "Folder for what it brings back")
      ->type_name("DIR")
      ->required();
  CLI::Option* in_process =
      command.add_flag("--in-process", options.in_process, "All stages in this process");
  command.add_flag("--resume", mission.resume, "Go on with the mission in the folder")
      ->excludes(world)
      ->excludes(in_process);
  command.add_option("--config", mission.config, "YAML file with sections of stages and sim")
      ->type_name("FILE");
  command.add_option("--fault", mission.faults, "As for adit sim; may be given several times")
      ->type_name("FAULT")
      ->allow_extra_args(false);
  command.add_option("--speed", mission.speed, "Times real time, or max: as fast as it goes")
      ->type_name("F|max")
      ->excludes(in_process);
  command.add_option("--time-max-s", mission.time_max_s, "Of simulated time, until it is given up")
      ->type_name("SECONDS")
      ->check(CLI::PositiveNumber);
}

}  // namespace

void add_mission_command(CLI::App& adit) {
  CLI::App* command = adit.add_subcommand("mission", "Send a robot into a simulated mine");
  command->footer(kMissionFooter);
  const auto options = std::make_shared<MissionOptions>();
  add_options(*command, *options);
  command->callback([options] { run(*options); });
}

}  // namespace adit
