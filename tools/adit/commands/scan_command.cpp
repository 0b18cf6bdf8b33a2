// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>

#include <CLI/App.hpp>
#include <fmt/format.h>

#include "common/command_line/command_line.hpp"
#include "sim/live/world_choice.hpp"
#include "sim/sweep/tilt_sweep.hpp"
#include "sim/view/view_options.hpp"
#include "sim/world/build_world.hpp"
#include "tools/adit/adit_app.hpp"
#include "tools/sim/sim_files.hpp"

namespace adit {
namespace {

struct ScanOptions {
  WorldChoice world;
  std::optional<Pose2> T_world_plan;
  std::filesystem::path file;
  std::string laser = "front";
};

constexpr const char* kScanDetails =
    R"(Simulates one sweep of a tilting laser of a stationary vehicle, with true poses.

Output:
  .lcmlog  the complete scan, as input of adit plan or of a stage
  .ply     the points only, in m; origin on the ground below the centre of the vehicle, x forward, y left,
           z up. The matching adit plan command is printed)";

constexpr const char* kScanExamples =
    R"(  adit scan mathies --at 308,5.84,-4.4 --out beam.lcmlog     in front of the broken beam
  adit scan bruceton --out start.ply                         at the start pose of the world
  adit plan beam.lcmlog --out beam)";

/// Mean of the origins of the lines, in level [m].
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
  std::cout << fmt::format("{}: {} points\n", options.file.string(), cloud.points());
  if (options.file.extension() != ".ply") return;
  const Eigen::Vector3f laser = laser_of(cloud);
  std::cout << fmt::format(
      "adit plan {} --laser-at {:g},{:g},{:g} --vehicle-at 0,0 --ground-m 0 --out DIR\n",
      options.file.string(), laser.x(), laser.y(), laser.z());
}

}  // namespace

void add_scan_command(CLI::App& adit) {
  CLI::App* command =
      add_command(adit, "scan", "Write a 3D scan of a simulated mine, as input of adit plan");
  set_help(*command, {kScanDetails, "", kScanExamples});
  const auto options = std::make_shared<ScanOptions>();
  add_world_options(*command, options->world)->required();
  command
      ->add_option_function<std::string>(
          "--at",
          [options](const std::string& pose) { options->T_world_plan = parse_view_pose(pose); },
          "Pose of the vehicle; by default the start pose of the world")
      ->type_name("X,Y,HEADING_DEG");
  command->add_option("--out", options->file, "Scan to write: LCM log (.lcmlog) or points (.ply)")
      ->type_name("FILE")
      ->required();
  command->add_option("--laser", options->laser, "Laser to sweep")
      ->check(CLI::IsMember({"front", "rear"}))
      ->capture_default_str();
  command->callback([options] { scan(*options); });
}

}  // namespace adit
