// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <CLI/App.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include "common/command_line/command_line.hpp"
#include "common/text/message_text.hpp"
#include "sim/live/live_run.hpp"
#include "tools/adit/adit_app.hpp"
#include "tools/mission/mission_folder.hpp"
#include "tools/mission/mission_live.hpp"
#include "tools/mission/mission_progress.hpp"
#include "tools/mission/mission_run.hpp"
#include "tools/report/report.hpp"
#include "tools/survey/survey.hpp"
#include "viewer/server/viewer_server.hpp"
#include "viewer/view/viewer_options.hpp"

namespace adit {
namespace {

/// Prints the progress of a mission: on a terminal one line that is updated, in a file one line
/// every ten seconds.
class MissionProgressPrinter {
 public:
  /// `wall_s` is the wall time since the start of the mission.
  void update(const MissionProgress& progress, double wall_s) {
    const double factor = wall_s > 0.0 ? progress.simulated_s / wall_s : 0.0;
    if (is_terminal_) {
      std::cout << fmt::format("\r{} ", message_line(progress_text(progress, factor)));
    } else if (wall_s >= next_s_) {
      std::cout << fmt::format("{}\n", message_line(progress_text(progress, factor)));
      next_s_ = wall_s + kLinePeriodS;
    }
    std::cout << std::flush;
  }

  /// Prints a message for the operator on standard error.
  void print_message(const std::string& message) const {
    if (is_terminal_) std::cout << "\n";
    std::cout << std::flush;
    print_error("adit mission", message);
  }

  /// Prints the outcome and the run time. `abort_reason` is empty if the mission ended by itself.
  static void end(const MissionProgress& last, const std::string& abort_reason,
                  const std::string& trace_failure, double wall_s) {
    for (const std::string& line : last.not_stored) print_error("adit mission", line);
    if (!trace_failure.empty()) print_error("adit mission", trace_failure);
    std::string outcome = abort_reason.empty() ? last.phase.reason : abort_reason;
    if (const std::string& why = last.phase.return_home_reason; !why.empty())
      outcome += "; it turned around: " + why;
    std::cout << fmt::format("\n{}\n", message_line(outcome))
              << fmt::format(
                     "{:.0f} s of simulated time in {:.0f} s; {:.2f} m from the start at "
                     "the end\n",
                     last.simulated_s, wall_s, last.distance_from_start_m)
              << std::flush;
  }

 private:
  static constexpr double kLinePeriodS = 10.0;

  bool is_terminal_ = isatty(STDOUT_FILENO) == 1;
  double next_s_ = 0.0;
};

constexpr int kExitNotReturned = 1;

struct MissionOptions {
  MissionLiveOptions mission;
  bool in_process = false;
  bool survey = false;
  bool no_view = false;
  int view_port = ViewerParameters{}.port;
};

constexpr const char* kMissionDetails =
    R"(Runs an autonomous mission in a simulated mine: the robot explores, scans, plans and drives, and returns
to the start. Each stage is a process under an adit-supervisor, on a private network. With --in-process, all
stages run in this process, and the same options give the same log to the byte.

Outputs in DIR:
  mission.html ..   the report and its files, see adit report --help
  run.lcmlog        all messages; run_2.lcmlog .. after --resume; with --compress run.lcmlog.zst ..,
                    which all commands read; adit export makes a plain one for lcm-logplayer
  survey/           with --survey: plan, sections, elevations, cloud, see adit survey --help
  phases.tsv        phases of the mission and their reasons
  *.journal         state of the stages, for --resume
  *.yaml, *.cfg     configuration of all processes

During the mission:
  http://127.0.0.1:8765/                     the live view: map, 3D, plots, processes; see adit view --help
  adit ps --socket DIR/supervisor.sock       list its processes; also adit logs NAME, adit restart NAME
  adit order return --mission DIR            order it to pause, resume, return or stop
  adit spy --mission DIR                     its messages in lcm-spy, and the mine drawn there

Faults are those of adit sim. The supervisor restarts processes that are killed or suspended.)";

constexpr const char* kMissionExitCodes =
    "  1  the robot did not leave the start, did not return to it, or is not sure that it did;\n"
    "     or the disk did not take the recording or what a stage stores, for want of space or\n"
    "     as it failed";

constexpr const char* kMissionExamples =
    R"(  adit mission mathies --out mission
  adit mission random --seed 7 --length-m 60 --out mission --fault kill:mapping@100
  adit mission --out mission --resume           after an interruption or a power loss
  adit mission mathies --in-process --out mission)";

/// Writes the report from the logs of the mission, also if the robot did not return. An error is
/// printed and does not change the outcome of the mission. A run that was killed immediately leaves
/// an empty log, which is skipped.
void report(const std::filesystem::path& folder) try {
  const MissionFolder mission(folder);
  std::vector<std::filesystem::path> logs = mission.logs();
  std::erase_if(logs, [](const auto& log) { return std::filesystem::file_size(log) == 0; });
  print_report({logs, mission.path()});
} catch (const std::exception& error) {
  print_error("adit mission", fmt::format("cannot write the report: {}", error.what()));
}

/// Surveys the mine without control into the folder `survey` of the mission. An error is printed
/// and does not change the outcome of the mission.
void survey_mine(const std::filesystem::path& folder) try {
  const SurveyOptions options{.mission = {folder}, .folder = folder / "survey"};
  print_survey(write_survey(options), options.folder);
} catch (const std::exception& error) {
  print_error("adit mission", fmt::format("cannot survey the mine: {}", error.what()));
}

/// Throws the exit code of a mission whose robot did not leave the start, did not return, or is not
/// sure that it did, or of which the disk did not take everything.
void require_return(const MissionProgress& last, const std::string& abort_reason,
                    const std::string& trace_failure) {
  const bool home = abort_reason.empty() && last.phase.outcome == MissionOutcome::kHome &&
                    !never_left_start(last.phase);
  if (!home || !last.not_stored.empty() || !trace_failure.empty())
    throw CLI::RuntimeError(kExitNotReturned);
}

void run_in_process(const MissionLiveOptions& mission, bool with_survey) {
  if (mission.resume)
    throw std::invalid_argument("--resume requires a mission of processes, without --in-process");
  MissionFolder(mission.folder).require_new();
  MissionRunOptions options;
  options.world = mission.world;
  options.folder = mission.folder;
  options.config = mission.config;
  options.faults = mission.faults;
  options.time_max_s = mission.time_max_s;
  options.log_form = mission.log_form;
  MissionProgressPrinter printer;
  const auto begin = std::chrono::steady_clock::now();
  const MissionRunResult result = run_mission(options, [&](const MissionProgress& progress) {
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
    printer.update(progress, wall.count());
  });
  const bool ended = result.last.phase.phase == Phase::kEnded;
  const std::string abort_reason = !result.failure.empty()
                                       ? fmt::format("the run failed: {}", result.failure)
                                   : ended ? ""
                                           : "the time limit is reached";
  MissionProgressPrinter::end(result.last, abort_reason, result.trace_failure, result.wall_s);
  report(mission.folder);
  if (with_survey) survey_mine(mission.folder);
  require_return(result.last, abort_reason, result.trace_failure);
}

/// The live view of a mission.
struct View {
  std::optional<int> socket = {};  ///< listens; none without a network
  std::string message;             ///< for the user: its address, or why there is none
};

/// Opens the port of the live view in the network of the user, before the mission enters its own.
/// Another port than `port` if that is in use.
View open_view(int port) try {
  const std::string address = ViewerParameters{}.address;
  View view;
  try {
    view.socket = listen_on(address, static_cast<std::uint16_t>(port));
  } catch (const std::runtime_error& error) {
    view.message = fmt::format("{}; the live view uses another port\n", error.what());
    view.socket = listen_on(address, 0);
  }
  view.message += fmt::format("live view   {}\n", browser_address(address, port_of(*view.socket)));
  return view;
} catch (const std::runtime_error& error) {
  return {.message = fmt::format("no live view: {}\n", error.what())};
}

void run_processes(const MissionOptions& options) {
  MissionLiveOptions mission = options.mission;
  const std::filesystem::path folder = std::filesystem::absolute(mission.folder);
  MissionProgressPrinter printer;
  if (mission.resume) {
    for (const std::string& report : journal_reports(MissionFolder(folder)))
      printer.print_message(report);
  }
  const View view = options.no_view ? View{} : open_view(options.view_port);
  mission.view_socket = view.socket;
  // Printed as the mission begins: one that cannot begin has its reason alone.
  std::string messages =
      fmt::format("{}messages    adit spy --mission {}\n", view.message, mission.folder.string());
  const MissionLiveResult result = run_live_mission(
      mission,
      [&](const MissionProgress& progress, double wall_s) {
        std::cout << std::exchange(messages, {}) << std::flush;
        printer.update(progress, wall_s);
      },
      [&](const std::string& message) { printer.print_message(message); });
  MissionProgressPrinter::end(result.last, result.abort_reason, result.trace_failure,
                              result.wall_s);
  if (!result.interrupted) {
    report(folder);
    if (options.survey) survey_mine(folder);
  }
  require_return(result.last, result.abort_reason, result.trace_failure);
}

void run(const MissionOptions& options) {
  if (options.mission.world.name.empty() == !options.mission.resume) {
    throw std::invalid_argument(
        "either WORLD or --resume, to continue the mission in --out, is required");
  }
  if (options.in_process) return run_in_process(options.mission, options.survey);
  run_processes(options);
}

void add_options(CLI::App& command, MissionOptions& options) {
  MissionLiveOptions& mission = options.mission;
  CLI::Option* world = add_world_options(command, mission.world);
  command.add_option("--world", mission.world.name, "Same as WORLD")->excludes(world);
  command.add_option("--out", mission.folder, "Output folder; created if it does not exist")
      ->type_name("DIR")
      ->required();
  CLI::Option* in_process =
      command.add_flag("--in-process", options.in_process, "Run all stages in this process");
  command.add_flag("--survey", options.survey,
                   "Survey the mine at the end, into DIR/survey; see adit survey --help");
  command.add_flag("--resume", mission.resume, "Continue the mission in the output folder")
      ->excludes(world)
      ->excludes(in_process);
  command.add_flag("--no-view", options.no_view, "Run without the live view")->excludes(in_process);
  command.add_option("--view-port", options.view_port, "Port of the live view; 0: any")
      ->type_name("N")
      ->check(number_in(within(0, 65535)))
      ->capture_default_str()
      ->excludes(in_process);
  command.add_option("--config", mission.config, "YAML file with sections of the stages and sim")
      ->type_name("FILE");
  command
      .add_option("--fault", mission.faults, "Fault to inject, as for adit sim; can be repeated")
      ->type_name("FAULT")
      ->allow_extra_args(false);
  command
      .add_option_function<std::string>(
          "--speed",
          [&mission](const std::string& text) {
            speed_factor(text);  // throws if invalid
            mission.speed = text;
          },
          "Speed as a multiple of real time, or max: as fast as possible")
      ->type_name("F|max")
      ->excludes(in_process);
  command
      .add_option("--time-max-s", mission.time_max_s,
                  "Simulated time after which the mission is aborted")
      ->type_name("SECONDS")
      ->check(number_in(above(0.0)));
  command.add_flag_callback(
      "--compress", [&mission] { mission.log_form = LogForm::kCompressed; },
      "Record run.lcmlog.zst, compressed with zstd, a third of the size");
}

}  // namespace

void add_mission_command(CLI::App& adit) {
  CLI::App* command = add_command(adit, "mission", "Run an autonomous mission in a simulated mine");
  set_help(*command, {kMissionDetails, kMissionExitCodes, kMissionExamples});
  const auto options = std::make_shared<MissionOptions>();
  add_options(*command, *options);
  command->callback([options] { run(*options); });
}

}  // namespace adit
