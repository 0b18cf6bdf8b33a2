// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>
#include <memory>
#include <stdexcept>

#include <CLI/App.hpp>
#include <fmt/format.h>

#include "common/command_line/command_line.hpp"
#include "tools/adit/adit_app.hpp"
#include "tools/adit/progress_bar.hpp"
#include "tools/drive/drive_run.hpp"
#include "tools/drive/live_drive.hpp"

namespace adit {
namespace {

struct DriveOptions {
  DriveRunOptions run;
  std::string lcm_url;
  std::string key;
  bool keyboard = false;
};

constexpr const char* kDriveDetails =
    R"(With WORLD, the command simulates the drive in this process, as fast as possible. The same world,
waypoints and seed give the same log to the byte. If the run fails, the log is kept.

Without WORLD, the command drives the vehicle on LCM: a simulator by its TRUTH, or, with --keyboard,
also a robot. --lcm-url selects the network.

Inputs:
  WAYPOINTS  text lines `x y` or `x y speed`, in m and m/s, in the frame of the world; # begins a comment

Outputs (with WORLD):
  --out      LCM log of all sensor messages
  --truth    true path in the TUM format)";

constexpr const char* kDriveExamples =
    R"(  adit drive bruceton --waypoints tour.txt --out run.lcmlog --truth run.tum
  adit map run.lcmlog --out mine
  adit drive mathies --waypoints in.txt --out dark.lcmlog --fault laser_dies:front@60
  adit drive --keyboard                                 arrows or w a s d; space stops, q quits
  adit drive --waypoints tour.txt                       the simulator on LCM)";

void drive_in_process(const DriveRunOptions& options) {
  if (options.waypoints.empty() || options.log.empty()) {
    throw std::invalid_argument("a drive through a world requires --waypoints and --out");
  }
  DriveRunResult result;
  {
    ProgressBar bar("driving");
    result = run_drive(options, [&](double done) { bar.update(done); });
  }
  std::cout << fmt::format(
      "{}: {} messages, {:.1f} m in {:.1f} s of simulated time, {:.1f} times real time\n",
      options.log.string(), result.messages, result.distance_travelled_m, result.simulated_s,
      result.simulated_s / result.wall_s);
  if (!result.failure.empty()) {
    throw std::runtime_error(fmt::format("the run failed: {}", result.failure));
  }
}

void drive(const DriveOptions& options) {
  if (!options.run.world.name.empty()) return drive_in_process(options.run);
  const LiveDriveOptions live{options.run.waypoints, options.run.config, options.lcm_url,
                              options.key};
  if (options.keyboard) return drive_by_keys(live);
  if (options.run.waypoints.empty()) {
    throw std::invalid_argument("either --keyboard or --waypoints is required");
  }
  drive_by_waypoints(live);
}

}  // namespace

void add_drive_command(CLI::App& adit) {
  CLI::App* command =
      add_command(adit, "drive",
                  "Drive the vehicle of a simulation or on LCM along waypoints or by the keyboard");
  set_help(*command, {kDriveDetails, "", kDriveExamples});
  const auto options = std::make_shared<DriveOptions>();
  CLI::Option* world = add_world_options(*command, options->run.world);
  CLI::Option* waypoints =
      command->add_option("--waypoints", options->run.waypoints, "Waypoints to follow")
          ->type_name("FILE");
  command->add_option("--out", options->run.log, "LCM log to write")
      ->type_name("FILE")
      ->needs(world);
  command->add_option("--truth", options->run.truth, "True path to write, in the TUM format")
      ->type_name("FILE")
      ->needs(world);
  command
      ->add_option("--fault", options->run.faults,
                   "Fault to inject, as for adit sim; not those of processes")
      ->type_name("FAULT")
      ->allow_extra_args(false)
      ->needs(world);
  command->add_option("--config", options->run.config, "YAML file with sections sim and vehicle")
      ->type_name("FILE");
  command->add_flag("--keyboard", options->keyboard, "Drive by the keyboard of the terminal")
      ->excludes(world)
      ->excludes(waypoints);
  command->add_option("--lcm-url", options->lcm_url, "LCM network, instead of the default")
      ->type_name("URL")
      ->excludes(world);
  add_key_option(*command, options->key);
  command->callback([options] { drive(*options); });
}

}  // namespace adit
