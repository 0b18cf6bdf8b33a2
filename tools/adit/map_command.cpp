// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>

#include "tools/adit/commands.hpp"
#include "tools/adit/progress_bar.hpp"
#include "tools/map/map_run.hpp"

namespace adit {
namespace {

constexpr const char* kFooter =
    R"(The folder then holds
  trajectory.tum        time x y z qx qy qz qw, one line for each scan
  map.png               a picture of the place with the path in it
  map.pgm, map.yaml     the same for ROS's map_server and nav2
  run.lcmlog            all messages that went in and came out, for lcm-logplayer and adit spy
  summary.json          scans, path length, times, memory, and where motion was not observed

Examples:
  adit map intel.log.gz --out intel                    a CARMEN log
  adit map run.lcmlog --out again --no-odometry        from the laser alone
  adit-scan_matching --print-config > my.yaml          every parameter there is; edit, then
  adit map run.lcmlog --out mine --config my.yaml)";

void map(const MapRunOptions& options) {
  std::optional<ProgressBar> bar;
  std::string shown;
  const MapRunResult result = run_map(options, [&](const std::string& label, double done) {
    if (label != shown) bar.emplace(label);
    shown = label;
    bar->update(done);
  });
  bar.reset();
  for (const std::string& sentence : result.complaints) {
    std::cerr << "adit: " << options.input.string() << ": skipped " << sentence << "\n";
  }
  std::cout << options.folder.string() << ": " << result.scans << " scans over "
            << result.path_length_m << " m in " << result.wall_s << " s, " << result.lost
            << " of them lost\n";
}

}  // namespace

void add_map_command(CLI::App& adit) {
  CLI::App* command =
      adit.add_subcommand("map", "Find the robot's path in a laser log, and draw the place");
  command->footer(kFooter);
  const auto options = std::make_shared<MapRunOptions>();
  command->add_option("INPUT", options->input, "A CARMEN log, plain or gzip, or an LCM log")
      ->type_name("FILE")
      ->required();
  command->add_option("--out", options->folder, "Where the results go; made if it is not there")
      ->type_name("DIR")
      ->required();
  command->add_option("--config", options->config, "YAML file with a section for each stage")
      ->type_name("FILE");
  command->add_flag_callback(
      "--no-odometry", [options] { options->use_odometry = false; },
      "Leave out wheel odometry and IMU: the laser alone");
  command->callback([options] { map(*options); });
}

}  // namespace adit
