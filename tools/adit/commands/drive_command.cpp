// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <iostream>
#include <memory>
#include <stdexcept>

#include <CLI/CLI.hpp>

#include "tools/adit/adit_app.hpp"
#include "tools/adit/progress_bar.hpp"
#include "tools/drive/drive_run.hpp"
#include "tools/drive/live_drive.hpp"

namespace adit {
namespace {

struct DriveOptions {
  DriveRunOptions run;
  std::string lcm_url;
  bool keys = false;
};

constexpr const char* kDriveFooter =
    R"(Through a mine in this process, as fast as it goes: the same mine, waypoints and seed give the same log,
byte for byte. A run that fails ends with exit code 2; the log is kept. Without WORLD, what is on LCM is
driven: a simulator, and with --keys a robot as well.

Waypoints are lines `x y` or `x y speed` in metres and m/s, in the frame of the mine; # begins a comment.

Examples:
  adit drive bruceton --waypoints tour.txt --out run.lcmlog --truth run.tum
  adit map run.lcmlog --out mine
  adit drive mathies --waypoints in.txt --out dark.lcmlog --fault laser_dies:front@60
  adit drive --keys                                     arrows or w a s d, space stops, q quits
  adit drive --waypoints tour.txt                       the simulator on LCM, by its TRUTH)";

void drive_in_process(const DriveRunOptions& options) {
  if (options.waypoints.empty() || options.log.empty()) {
    throw std::invalid_argument("a drive through a mine needs --waypoints and --out");
  }
  DriveRunResult result;
  {
    ProgressBar bar("driving");
    result = run_drive(options, [&](double done) { bar.update(done); });
  }
  std::printf("%s: %lld messages, %.1f m in %.1f s of simulated time, %.1f times real time\n",
              options.log.c_str(), static_cast<long long>(result.messages),
              result.distance_travelled_m, result.simulated_s, result.simulated_s / result.wall_s);
  if (!result.failure.empty()) throw std::runtime_error("the run has failed: " + result.failure);
}

void drive(const DriveOptions& options) {
  if (!options.run.world.name.empty()) return drive_in_process(options.run);
  const LiveDriveOptions live{options.run.waypoints, options.run.config, options.lcm_url};
  if (options.keys) return drive_by_keys(live);
  if (options.run.waypoints.empty()) {
    throw std::invalid_argument("say how to drive: --keys or --waypoints");
  }
  drive_by_waypoints(live);
}

}  // namespace

void add_drive_command(CLI::App& adit) {
  CLI::App* command =
      adit.add_subcommand("drive", "Drive through a mine and record it, or what is on LCM");
  command->footer(kDriveFooter);
  const auto options = std::make_shared<DriveOptions>();
  CLI::Option* world = add_world_options(*command, options->run.world);
  CLI::Option* waypoints =
      command->add_option("--waypoints", options->run.waypoints, "Where to drive")
          ->type_name("FILE");
  command->add_option("--out", options->run.log, "The LCM log to write")
      ->type_name("FILE")
      ->needs(world);
  command->add_option("--truth", options->run.truth, "Also write the true path, in the TUM format")
      ->type_name("FILE")
      ->needs(world);
  command->add_option("--fault", options->run.faults, "As for adit sim, but for those of processes")
      ->type_name("FAULT")
      ->allow_extra_args(false)
      ->needs(world);
  command->add_option("--config", options->run.config, "YAML file with a section sim or vehicle")
      ->type_name("FILE");
  command->add_flag("--keys", options->keys, "By the keys of the terminal")
      ->excludes(world)
      ->excludes(waypoints);
  command->add_option("--lcm-url", options->lcm_url, "Where LCM is, if not at its default")
      ->type_name("URL")
      ->excludes(world);
  command->callback([options] { drive(*options); });
}

}  // namespace adit
