// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>
#include <memory>
#include <optional>

#include <CLI/App.hpp>
#include <fmt/format.h>

#include "common/command_line/command_line.hpp"
#include "common/text/message_text.hpp"
#include "tools/adit/adit_app.hpp"
#include "tools/adit/run_progress.hpp"
#include "tools/adit/topic_options.hpp"
#include "tools/map/map_run.hpp"

namespace adit {
namespace {

constexpr const char* kMapDetails =
    R"(Estimates the trajectory of the robot by scan matching, detects loop closures and optimizes the pose
graph.

Outputs in DIR:
  trajectory.tum        corrected trajectory: time x y z qx qy qz qw, one line per scan
  odometry.tum          trajectory of scan matching before loop closure: smooth, with drift
  map.png               picture of the map with the trajectory
  map.pgm, map.yaml     occupancy grid for ROS map_server and Nav2
  graph.g2o             pose graph of local maps
  associations.tsv      loop closure decisions, with time and reason; also those that were revoked
  map.journal           state of mapping, for --resume
  run.lcmlog            all input and output messages, for lcm-logplayer and adit spy
  summary.json          scans, path length, loop closures, computation times, memory, degenerate motion,
                        stretches on which the map may be wrong

Of a bag of ROS (ROS 1, rosbag2, MCAP) the topics are chosen as by adit import bag, which explains them; of a folder
of point clouds the level slices are mapped (adit import clouds).

The poses of the lasers on the body are read from the section `lasers` of the configuration, else from the
log (channel CONFIG); by default the lasers are at the origin of the body.

With --resume, the map keeps its frame, and the start of the recording is localized anywhere in it. The
trajectory and the pictures then show both runs. A localization by only one or two loop closures can be
wrong: check map.png with --draw-graph. DIR and the folder to resume may be the same.)";

constexpr const char* kMapExamples =
    R"(  adit map intel.log.gz --out intel                    a CARMEN log
  adit map run.bag --out mine --front /scan            a bag of ROS, with two lasers
  adit map run.lcmlog --out laser_only --no-odometry   laser only
  adit map second.lcmlog --out both --resume first     continue the map in the folder first
  adit-mapping --print-config > my.yaml                print all parameters of a stage, edit them, then
  adit map run.lcmlog --out mine --config my.yaml)";

void map(const MapRunOptions& options) {
  std::optional<RunProgress> progress(std::in_place, options.folder);
  const MapRunResult result =
      run_map(options, [&](const std::string& step, double done) { progress->update(step, done); });
  progress.reset();
  for (const std::string& message : result.warnings) {
    print_error("adit", fmt::format("{}: {}", options.input.string(), message));
  }
  std::cout << fmt::format(
      "{}: {} scans over {:g} m in {:g} s, {} of them lost; {} local maps, {} loop closure{}",
      options.folder.string(), result.scans, result.path_length_m, result.wall_s, result.lost,
      result.local_maps, result.loop_closures, result.loop_closures == 1 ? "" : "s");
  if (!options.resume.empty()) {
    std::cout << fmt::format(", {} of them to the map in {}", result.cross_session_loop_closures,
                             options.resume.string());
  }
  std::cout << "\n";
  if (!result.doubtful.empty()) std::cout << result.doubtful << "\n";
}

}  // namespace

void add_map_command(CLI::App& adit) {
  CLI::App* command =
      add_command(adit, "map", "Build a 2D map and the trajectory from a laser log (SLAM)");
  set_help(*command, {kMapDetails, "", kMapExamples});
  const auto options = std::make_shared<MapRunOptions>();
  command
      ->add_option("INPUT", options->input,
                   "LCM log, CARMEN log (plain or gzip), bag of ROS, or folder of point clouds")
      ->type_name("FILE")
      ->required();
  command->add_option("--out", options->folder, "Output folder; created if it does not exist")
      ->type_name("DIR")
      ->required();
  command->add_option("--config", options->config, "YAML file with a section per stage")
      ->type_name("FILE");
  command->add_flag_callback(
      "--no-odometry", [options] { options->use_odometry = false; },
      "Ignore wheel odometry and IMU; use the laser only");
  command
      ->add_option("--resume", options->resume,
                   "Continue the map in the output folder of an earlier run")
      ->type_name("DIR");
  command->add_flag("--draw-graph", options->draw_graph,
                    "Draw local maps and loop closures in map.png, also revoked ones");
  add_topic_options(*command, options->topics);
  command->callback([options] { map(*options); });
}

}  // namespace adit
