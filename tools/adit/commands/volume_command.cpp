// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>
#include <memory>

#include <CLI/App.hpp>
#include <fmt/format.h>

#include "common/command_line/command_line.hpp"
#include "common/text/message_text.hpp"
#include "tools/adit/adit_app.hpp"
#include "tools/adit/progress_bar.hpp"
#include "tools/volume/volume_run.hpp"

namespace adit {
namespace {

constexpr const char* kVolumeDetails =
    R"(Input: an LCM log with the channels CLOUD, POSE_GRAPH and MAP_CORRECTION, recorded while scan_assembly
and mapping ran.

Outputs in DIR, in the map frame of the last pose graph in the log:
  volume.bt     free and occupied cells as a binary OctoMap, for octovis
  volume.ot     the same with log-odds
  cloud.ply     points, each with the id of its scan)";

constexpr const char* kVolumeExamples =
    R"(  adit volume run.lcmlog --out mine
  adit-volume_map --print-config > my.yaml             print all parameters, edit them, then
  adit volume run.lcmlog --out mine --config my.yaml)";

void build_volume(const VolumeRunOptions& options) {
  VolumeRunResult result;
  {
    ProgressBar bar("volume");
    result = run_volume(options, [&bar](double done) { bar.update(done); });
  }
  for (const std::string& message : result.warnings) {
    print_error("adit", fmt::format("{}: {}", options.input.string(), message));
  }
  std::cout << fmt::format("{}: {} 3D scans in {} sub-volumes, {} points\n",
                           options.folder.string(), result.scans, result.volumes, result.points);
}

}  // namespace

void add_volume_command(CLI::App& adit) {
  CLI::App* command = add_command(
      adit, "volume", "Build a 3D map (OctoMap) and a point cloud from the 3D scans in a log");
  set_help(*command, {kVolumeDetails, "", kVolumeExamples});
  const auto options = std::make_shared<VolumeRunOptions>();
  command->add_option("LOG", options->input, "LCM log")->type_name("FILE")->required();
  command->add_option("--out", options->folder, "Output folder; created if it does not exist")
      ->type_name("DIR")
      ->required();
  command->add_option("--config", options->config, "YAML file with the section volume_map")
      ->type_name("FILE");
  command->callback([options] { build_volume(*options); });
}

}  // namespace adit
