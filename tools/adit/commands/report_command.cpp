// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/adit/commands/report_command.hpp"

#include <iostream>
#include <memory>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "tools/adit/adit_app.hpp"
#include "tools/adit/progress_bar.hpp"

namespace adit {

void print_report(const ReportOptions& options) {
  std::optional<ProgressBar> bar;
  std::string shown_label;
  const MissionReport result = write_report(options, [&](const std::string& label, double done) {
    if (label != shown_label) bar.emplace(label);
    shown_label = label;
    bar->update(done);
  });
  bar.reset();
  for (const std::string& message : result.warnings) std::cerr << "adit: " << message << "\n";
  std::cout << (options.folder / "mission.html").string() << ": " << result.outcome << std::endl;
}

namespace {

constexpr const char* kReportFooter =
    R"(The folder then holds
  mission.html          how the mission went, its map, phases, 3D scans, openings, events: one page that
                        needs nothing else, to be read, printed and passed on
  map.png, map.svg      the map with the way of the robot
  map.pgm, map.yaml     the same for ROS's map_server and nav2
  graph.g2o             the pose graph
  trajectory.tum        the path in the map: time x y z qx qy qz qw
  cloud.ply             the points of all 3D scans, in the map
  volume.bt             the mine as an OctoMap
  junctions.geojson     corridors, junctions, dead ends, openings and what became of them; metres in the map
  summary.json          the figures, and the configuration of each stage
  run.lcmlog            the log

Several logs are those of one mission after restarts, in order. The map is the one in the log (LOCAL_MAP,
POSE_GRAPH); with --remap it is made anew from the laser scans and their matches. What a log does not hold
is left out, and said.

Examples:
  adit report run.lcmlog --out mission
  adit report before.lcmlog after.lcmlog --out mission
  adit report run.lcmlog --out again --remap)";

}  // namespace

void add_report_command(CLI::App& adit) {
  CLI::App* command = adit.add_subcommand(
      "report", "Make the folder of a mission from its log: a page to read, map, volume, figures");
  command->footer(kReportFooter);
  const auto options = std::make_shared<ReportOptions>();
  command->add_option("LOG", options->logs, "LCM logs of one mission, in order of time")
      ->type_name("FILE")
      ->required();
  command->add_option("--out", options->folder, "Where the results go; made if it is not there")
      ->type_name("DIR")
      ->required();
  command->add_flag("--remap", options->remap, "Make the map anew from the laser scans");
  command->callback([options] { print_report(*options); });
}

}  // namespace adit
