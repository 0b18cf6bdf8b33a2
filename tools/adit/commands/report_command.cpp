// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <CLI/App.hpp>
#include <fmt/format.h>

#include "common/command_line/command_line.hpp"
#include "common/text/message_text.hpp"
#include "tools/adit/adit_app.hpp"
#include "tools/adit/run_progress.hpp"
#include "tools/report/report.hpp"
#include "viewer/view/viewer_options.hpp"

namespace adit {

void print_report(ReportOptions options) {
  options.viewer_page = viewer_page();
  std::optional<RunProgress> progress(std::in_place, options.folder);
  const MissionReport result = write_report(
      options, [&](const std::string& step, double done) { progress->update(step, done); });
  progress.reset();
  for (const std::string& message : result.warnings) print_error("adit", message);
  if (!result.accuracy.empty()) std::cout << result.accuracy << "\n";
  const auto place = result.page_bytes > 0 ? options.folder / "mission.html" : options.folder;
  std::cout << message_line(fmt::format("{}: {}", place.string(), result.outcome)) << "\n"
            << std::flush;
}

namespace {

constexpr const char* kReportDetails =
    R"(Outputs in DIR:
  mission.html          the page of the viewer with the mission inside: map, 3D, time, plots, 3D scans
  map.png, map.svg      map with the traversed path
  map.pgm, map.yaml     occupancy grid for ROS map_server and Nav2
  graph.g2o             pose graph
  trajectory.tum        trajectory in the map frame: time x y z qx qy qz qw
  cloud.ply             points of all 3D scans in the map frame
  volume.bt             3D map as an OctoMap
  junctions.geojson     corridors, junctions, dead ends and frontiers with their outcome; map frame [m]
  summary.json          figures, and the configuration of each stage
  run.lcmlog            the log

Several logs are the logs of one mission after restarts, or the files of a recording; they are read by the
time of their first message, whatever their order and names. The map is read from the log
(LOCAL_MAP, POSE_GRAPH); --remap computes it from the laser scans and their matches. Outputs whose messages
are missing in the log are omitted with a warning.)";

constexpr const char* kReportExamples =
    R"(  adit report run.lcmlog --out mission
  adit report run-*.lcmlog* --out mission                  all files of a recording of adit-record
  adit report run.lcmlog --out remapped --remap)";

}  // namespace

void add_report_command(CLI::App& adit) {
  CLI::App* command =
      add_command(adit, "report",
                  "Create the report of a mission from its log: HTML page, maps, 3D map, figures");
  set_help(*command, {kReportDetails, "", kReportExamples});
  const auto options = std::make_shared<ReportOptions>();
  command->add_option("LOG", options->logs, "LCM logs of one mission")
      ->type_name("FILE")
      ->required();
  command->add_option("--out", options->folder, "Output folder; created if it does not exist")
      ->type_name("DIR")
      ->required();
  command->add_flag("--remap", options->remap, "Compute the map from the laser scans");
  command->callback([options] { print_report(*options); });
}

}  // namespace adit
