// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "sim/live/world_choice.hpp"
#include "sim/sweep/tilt_sweep.hpp"
#include "sim/view/view_options.hpp"
#include "sim/world/build_world.hpp"
#include "tools/adit/adit_app.hpp"
#include "tools/sim/scan_file.hpp"

namespace adit {
namespace {

struct ScanOptions {
  WorldChoice world;
  std::optional<Pose2> T_world_plan;
  std::filesystem::path file;
  std::string laser = "front";
};

constexpr const char* kScanFooter =
    R"(One sweep of a tilting laser of a vehicle that stands there, as the simulator's laser sees it,
placed without error. A log holds all of it, for adit plan or a stage; a PLY file the bare points, in metres
from where the vehicle's middle stands on the ground, x ahead, y to the left, z up.

Examples:
  adit scan mathies --at 308,5.84,-4.4 --out beam.lcmlog     before the broken beam
  adit scan bruceton --out start.ply                         where the world has its start
  adit plan beam.lcmlog --out beam)";

/// The mean of where the lines begin.
Eigen::Vector3f laser_of(const Cloud& cloud) {
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (const CloudLine& line : cloud.lines) sum += line.origin;
  return sum / static_cast<float>(cloud.lines.size());
}

void scan(const ScanOptions& options) {
  const Site site(build_world(describe(options.world)));
  TiltSweep sweep;
  if (options.laser == "rear") sweep.mount = groundhog_lasers().rear;
  const Pose2 T_world_plan = options.T_world_plan.value_or(site.world().T_world_start);
  const Cloud cloud = tilt_sweep(site, standing(site, T_world_plan), sweep);
  write_scan(cloud, options.file);
  std::cout << options.file.string() << ": " << cloud.points() << " points\n";
  if (options.file.extension() != ".ply") return;
  const Eigen::Vector3f laser = laser_of(cloud);
  std::cout << "adit plan " << options.file.string() << " --origin " << laser.x() << ","
            << laser.y() << "," << laser.z() << " --stand 0,0 --ground 0 --out DIR\n";
}

}  // namespace

void add_scan_command(CLI::App& adit) {
  CLI::App* command =
      adit.add_subcommand("scan", "Write a 3D scan of a simulated mine, to plan on");
  command->footer(kScanFooter);
  const auto options = std::make_shared<ScanOptions>();
  add_world_options(*command, options->world)->required();
  command
      ->add_option_function<std::string>(
          "--at",
          [options](const std::string& place) { options->T_world_plan = parse_view_pose(place); },
          "Where the vehicle stands; at the start of the world without")
      ->type_name("X,Y,HEADING_DEG");
  command->add_option("--out", options->file, "An LCM log (.lcmlog) or bare points (.ply)")
      ->type_name("FILE")
      ->required();
  command->add_option("--laser", options->laser, "Which of the two")
      ->check(CLI::IsMember({"front", "rear"}))
      ->capture_default_str();
  command->callback([options] { scan(*options); });
}

}  // namespace adit
