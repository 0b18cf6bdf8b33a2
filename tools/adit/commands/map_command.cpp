// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>

#include "tools/adit/adit_app.hpp"
#include "tools/adit/progress_bar.hpp"
#include "tools/map/map_run.hpp"

namespace adit {
namespace {

constexpr const char* kMapFooter =
    R"(The folder then holds
  trajectory.tum        the path in the map: time x y z qx qy qz qw, one line for each scan
  odometry.tum          the same before loops were closed: smooth, but it drifts
  map.png               a picture of the place with the path in it
  map.pgm, map.yaml     the same for ROS's map_server and nav2
  graph.g2o             the pose graph: local maps, and what holds them together
  associations.tsv      which places were taken for the same, when and why; what was undone
  map.journal           what mapping knows, for --resume
  run.lcmlog            all messages that went in and came out, for lcm-logplayer and adit spy
  summary.json          scans, path length, closures, times, memory, where motion was not observed

Where the lasers sit on the body is taken from the section `lasers` of the configuration, or else from the
log, if it says so itself (channel CONFIG), or else they sit at the body's origin.

A map that is resumed keeps its frame. The recording is looked for in it as if the robot might have been
carried anywhere; afterwards path and pictures show both. One or two closures that hold it there may be
mistaken: look at map.png with --draw-graph. DIR and the folder to resume may be the same.

Examples:
  adit map intel.log.gz --out intel                    a CARMEN log
  adit map run.lcmlog --out again --no-odometry        from the laser alone
  adit map second.lcmlog --out both --resume first     go on with the map in the folder first
  adit-mapping --print-config > my.yaml                every parameter of a stage; edit, then
  adit map run.lcmlog --out mine --config my.yaml)";

void map(const MapRunOptions& options) {
  std::optional<ProgressBar> bar;
  std::string shown_label;
  const MapRunResult result = run_map(options, [&](const std::string& label, double done) {
    if (label != shown_label) bar.emplace(label);
    shown_label = label;
    bar->update(done);
  });
  bar.reset();
  for (const std::string& message : result.warnings) {
    std::cerr << "adit: " << options.input.string() << ": " << message << "\n";
  }
  std::cout << options.folder.string() << ": " << result.scans << " scans over "
            << result.path_length_m << " m in " << result.wall_s << " s, " << result.lost
            << " of them lost; " << result.local_maps << " local maps, " << result.loop_closures
            << (result.loop_closures == 1 ? " closure" : " closures");
  if (!options.resume.empty()) {
    std::cout << ", " << result.cross_session_loop_closures << " of them to the map of "
              << options.resume.string();
  }
  std::cout << "\n";
}

}  // namespace

void add_map_command(CLI::App& adit) {
  CLI::App* command = adit.add_subcommand(
      "map", "Find the robot's path in a laser log, close its loops, and draw the place");
  command->footer(kMapFooter);
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
  command
      ->add_option("--resume", options->resume, "Continue the map in this folder of an earlier run")
      ->type_name("DIR");
  command->add_flag("--draw-graph", options->draw_graph,
                    "Draw local maps and closures into map.png, those that were undone too");
  command->callback([options] { map(*options); });
}

}  // namespace adit
