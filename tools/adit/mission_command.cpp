// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <memory>
#include <stdexcept>

#include <CLI/CLI.hpp>

#include "tools/adit/commands.hpp"
#include "tools/mission/mission_run.hpp"

namespace adit {
namespace {

constexpr const char* kFooter =
    R"(Sends a robot into a simulated mine: it explores, scans, plans and drives by itself, and comes home.

Examples:
  adit mission mathies --in-process --out mission
  adit mission random --seed 7 --in-process --out mission)";

const char* name_of(Phase phase) {
  constexpr const char* kNames[] = {"waiting", "explore", "scan", "plan",
                                    "execute", "paused",  "ended"};
  return kNames[static_cast<int>(phase)];
}

void print(const MissionProgress& progress) {
  const MissionPhase& phase = progress.phase;
  std::printf(
      "\r%6.0f s  %-8s %s  %6.1f m driven, %6.1f m from the start, %3d local maps, %3d scans ",
      progress.simulated_s, name_of(phase.phase), phase.homeward ? "homeward" : "outbound",
      phase.travelled_m, progress.from_start_m, progress.local_maps, phase.scans);
  std::fflush(stdout);
}

void run(const MissionRunOptions& options) {
  std::int32_t told = -1;
  const MissionRunResult result = run_mission(options, [&](const MissionProgress& progress) {
    print(progress);
    if (progress.phase.sequence != told && std::getenv("ADIT_TRACE"))
      std::printf("%s\n", progress.phase.reason.c_str());
    told = progress.phase.sequence;
  });
  print(result.last);
  std::printf(
      "\n%s\n%.0f s of simulated time in %.0f s; farthest %.1f m, %.2f m from the start at the "
      "end\n",
      result.last.phase.reason.c_str(), result.last.simulated_s, result.wall_s, result.farthest_m,
      result.home_off_m);
  if (!result.failure.empty()) throw std::runtime_error("the run has failed: " + result.failure);
}

}  // namespace

void add_mission_command(CLI::App& adit) {
  CLI::App* command = adit.add_subcommand("mission", "Send a robot into a simulated mine");
  command->footer(kFooter);
  const auto options = std::make_shared<MissionRunOptions>();
  add_world_options(*command, options->world)->required();
  command->add_option("--out", options->folder, "Folder for what it brings back")
      ->type_name("DIR")
      ->required();
  command->add_option("--fault", options->faults, "As for adit sim")
      ->type_name("FAULT")
      ->allow_extra_args(false);
  command->add_option("--config", options->config, "YAML file")->type_name("FILE");
  command->add_flag("--in-process", options->in_process, "All stages in this process");
  command->callback([options] { run(*options); });
}

}  // namespace adit
