// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>
#include <memory>

#include <CLI/CLI.hpp>

#include "tools/adit/adit_app.hpp"
#include "tools/adit/progress_bar.hpp"
#include "tools/volume/volume_run.hpp"

namespace adit {
namespace {

constexpr const char* kVolumeFooter =
    R"(The folder then holds
  volume.bt     which cells are free and which are occupied: OctoMap's binary form, for octovis
  volume.ot     the same with log-odds
  cloud.ply     the points, each with the id of its scan

All are in map, as the last pose graph of the log has it. The log holds the channels CLOUD, POSE_GRAPH
and MAP_CORRECTION, as one has that was recorded while scan_assembly and mapping ran.

Examples:
  adit volume run.lcmlog --out mine
  adit-volume_map --print-config > my.yaml             every parameter; edit, then
  adit volume run.lcmlog --out mine --config my.yaml)";

void make_volume(const VolumeRunOptions& options) {
  VolumeRunResult result;
  {
    ProgressBar bar("volume");
    result = run_volume(options, [&bar](double done) { bar.update(done); });
  }
  for (const std::string& message : result.warnings) {
    std::cerr << "adit: " << options.input.string() << ": " << message << "\n";
  }
  std::cout << options.folder.string() << ": " << result.scans << " 3D scans in " << result.volumes
            << " sub-volumes, " << result.points << " points\n";
}

}  // namespace

void add_volume_command(CLI::App& adit) {
  CLI::App* command =
      adit.add_subcommand("volume", "Make a volume and a cloud of points of the 3D scans in a log");
  command->footer(kVolumeFooter);
  const auto options = std::make_shared<VolumeRunOptions>();
  command->add_option("LOG", options->input, "An LCM log")->type_name("FILE")->required();
  command->add_option("--out", options->folder, "Where the results go; made if it is not there")
      ->type_name("DIR")
      ->required();
  command->add_option("--config", options->config, "YAML file with a section volume_map")
      ->type_name("FILE");
  command->callback([options] { make_volume(*options); });
}

}  // namespace adit
