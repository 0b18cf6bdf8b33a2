// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// mines_table WORLD WAYPOINTS..: drives through simulated mines, maps the laser scans with and
// without wheel odometry and IMU, and scores the maps by the ground truth, as a table in Markdown.
#include <exception>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "sim/world/build_world.hpp"
#include "sim/world/world_file.hpp"
#include "tests/eval/markdown.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tools/drive/drive_run.hpp"
#include "tools/eval/map_image.hpp"
#include "tools/eval/map_score.hpp"
#include "tools/eval/trajectory.hpp"
#include "tools/eval/trajectory_score.hpp"
#include "tools/map/map_run.hpp"

namespace adit {
namespace {

struct Options {
  std::vector<std::string> drives;  // world, waypoints, world, waypoints, ..
  std::filesystem::path config;
};

DriveRunResult drive(const std::string& world, const std::filesystem::path& waypoints,
                     const std::filesystem::path& config, const std::filesystem::path& log) {
  DriveRunOptions options;
  options.world.name = world;
  options.waypoints = waypoints;
  options.config = config;
  options.log = log;
  DriveRunResult result = run_drive(options);
  if (!result.failure.empty()) throw std::runtime_error(world + ": " + result.failure);
  return result;
}

std::string score_columns(const std::filesystem::path& folder, const Site& site) {
  const Trajectory truth = read_ground_truth(folder / "run.lcmlog");
  const TrajectoryScore path = score_trajectory(read_tum(folder / "trajectory.tum"), truth);
  const MapScore map =
      score_map(read_occupied_cells(folder / "map.yaml"), path.T_world_map, site, truth);
  return format(" %.3f | %.2f | %.3f | %.4f | %.2f %% | %.2f %% | %.3f, %.3f |",
                path.aligned.rmse_m, path.aligned.max_m, path.anchored.rmse_m, path.length_ratio,
                100.0 * map.coverage, 100.0 * map.deviation, map.wall_distance.median_m,
                map.wall_distance.p95_m);
}

void print_rows(const std::string& world, const std::filesystem::path& waypoints,
                const std::filesystem::path& config) {
  const test::ScratchFolder scratch;
  const DriveRunResult run = drive(world, waypoints, config, scratch / "run.lcmlog");
  const Site site(build_world(find_world(world)));
  for (const bool use_odometry : {true, false}) {
    const std::filesystem::path folder = scratch / (use_odometry ? "with" : "without");
    const MapRunResult map =
        run_map({scratch / "run.lcmlog", folder, config, use_odometry, {}, false},
                [](const std::string&, double) {});
    std::cout << format("| %s | %.0f | %.0f | %s | %zu |", world.c_str(), run.distance_travelled_m,
                        run.simulated_s / run.wall_s, use_odometry ? "yes" : "no", map.scans)
              << score_columns(folder, site)
              << format(" %zu | %.0f |\n", map.loop_closures, map.wall_s) << std::flush;
  }
}

void print_table(const Options& options) {
  print_heading(
      "| mine | path length (m) | drive, × real time | wheels, IMU | scans | RMSE (m) "
      "| largest error (m) | RMSE, anchored (m) | length ratio | coverage | deviation "
      "| distance from walls: median, 95 % (m) | loop closures | mapped in (s) |");
  for (std::size_t i = 0; i + 1 < options.drives.size(); i += 2) {
    print_rows(options.drives[i], options.drives[i + 1], options.config);
  }
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) try {
  CLI::App app("Drives, maps and scores simulated mines, as a table in Markdown");
  adit::Options options;
  app.add_option("DRIVES", options.drives, "Worlds, each followed by its waypoint file")
      ->required();
  app.add_option("--config", options.config, "YAML file with sections sim, scan_matching, mapping");
  CLI11_PARSE(app, argc, argv);
  adit::print_table(options);
  return 0;
} catch (const std::exception& error) {
  std::cerr << "mines_table: " << error.what() << "\n";
  return 2;
}
