// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// figure4 FOLDER [--yaw-bias-deg-per-m B]: draws the map of the drive through two parallel
// corridors before and after the revision at the corner, and prints a table row in Markdown
// (docs/results/parallel_corridors.md).
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <exception>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <fmt/format.h>

#include "common/picture/map_picture.hpp"
#include "tests/support/drives/parallel_drive.hpp"

namespace adit {
namespace {

// Drawn area: the two corridors, in the frame of the first local map [m].
const Eigen::AlignedBox2d kShown(Eigen::Vector2d(-14.0, -10.0), Eigen::Vector2d(96.0, 24.0));
constexpr double kRangeMax = 8.0;    // m; at longer range, walls are sampled too sparsely
constexpr double kResolution = 0.1;  // m

bool is_shown(const Pose2& pose) { return kShown.contains(pose.translation()); }

/// The map at one time: poses and constraints of the local maps, and revoked loop closures.
struct MapSnapshot {
  MapGraph graph;
  std::vector<LoopClosure> revoked;
  int path_start_map = 0;  ///< first local map of the drawn path
};

GraphPicture::Edge edge(const std::vector<Pose2>& poses, int a, int b) {
  return {poses[static_cast<std::size_t>(a)].translation(),
          poses[static_cast<std::size_t>(b)].translation()};
}

GraphPicture graph_picture(const MapSnapshot& snapshot) {
  GraphPicture picture;
  const std::vector<Pose2>& poses = snapshot.graph.poses;
  std::ranges::copy_if(poses, std::back_inserter(picture.nodes), is_shown);
  for (const auto& [measured, kind] : snapshot.graph.constraints) {
    const auto [a, b] = edge(poses, measured.from, measured.to);
    if (!kShown.contains(a) || !kShown.contains(b)) continue;
    auto& edges =
        kind == MapConstraint::Kind::kLoopClosure ? picture.loop_closures : picture.sequential;
    edges.push_back({a, b});
  }
  for (const LoopClosure& loop_closure : snapshot.revoked) {
    picture.revoked.push_back(
        edge(poses, loop_closure.alternatives.front().older_map, loop_closure.newer_map));
  }
  return picture;
}

void draw(const std::vector<LocalMap>& maps, const MapSnapshot& snapshot, const std::string& title,
          const std::filesystem::path& path) {
  OccupancyGrid grid({.resolution_m = kResolution, .range_max_m = kRangeMax});
  MapPicture picture;
  picture.title = title;
  picture.graph = graph_picture(snapshot);
  for (const LocalMap& map : maps) {
    for (const LocalScan& scan : map.scans) {
      const Pose2 T_map_body =
          snapshot.graph.poses[static_cast<std::size_t>(map.id)] * scan.T_local_body;
      if (!is_shown(T_map_body) || !grid.insert(scan.scan, T_map_body)) continue;
      if (map.id >= snapshot.path_start_map) picture.path.push_back(T_map_body);
    }
  }
  write_map_png(grid, picture, path);
}

/// Adds a local map at the pose predicted by its displacement from the previous local map.
MapGraph extended(MapGraph graph, const LocalMap& map) {
  graph.poses.push_back(graph.poses.back() * map.T_previous_local);
  return graph;
}

std::vector<LoopClosure> revoked_loop_closures(const MapUpdate& update) {
  std::vector<LoopClosure> revoked;
  for (const Association& a : update.associations) {
    const bool was_accepted = a.previously_chosen != Association::kNone;
    if (was_accepted && a.chosen != a.previously_chosen) revoked.push_back(a.loop_closure);
  }
  return revoked;
}

void print_row(double bias, const MapUpdate& update, double before_m, double after_m,
               double seconds, const PathError& end) {
  char row[200];
  std::snprintf(row, sizeof(row), "| %.3f | %d | %d | %d | %.1f | %.2f | %.0f | %.2f | %.2f |\n",
                bias, update.map.id, test::revoked(update), test::newly_accepted(update), before_m,
                after_m, 1e3 * seconds, end.rmse_m, end.farthest_m);
  std::cout << row;
}

void make_figure(const std::filesystem::path& folder, double bias) {
  test::ParallelDrive drive(bias);
  MapGraph before;
  double before_m = 0.0;
  auto start = std::clock();
  auto update = drive.next();
  for (; update && test::revoked(*update) == 0; start = std::clock(), update = drive.next()) {
    before = drive.mapping().graph();
    before_m = drive.newest_error_m();
  }
  if (!update) {
    const PathError end = drive.error();
    throw std::runtime_error(
        fmt::format("no loop closure was revoked; at the end of the drive RMSE {:.2f} m, largest "
                    "error {:.2f} m",
                    end.rmse_m, end.farthest_m));
  }
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  const double after_m = drive.newest_error_m();

  const std::vector<LoopClosure> revoked = revoked_loop_closures(*update);
  const int first = revoked.front().newer_map;
  const auto& maps = drive.mapping().local_maps();
  draw(maps, {extended(before, update->map), {}, first}, "Before revision: in the wrong corridor",
       folder / "parallel_corridors_before.png");
  draw(maps, {drive.mapping().graph(), revoked, first}, "After revision: in the right corridor",
       folder / "parallel_corridors_after.png");
  while (drive.next()) {
  }
  print_row(bias, *update, before_m, after_m, seconds, drive.error());
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) try {
  CLI::App app(
      "Draws figure 4 of the paper: two parallel corridors, before and after the revision");
  std::filesystem::path folder;
  double bias = -0.026;
  app.add_option("FOLDER", folder, "Output folder of the pictures")->required();
  app.add_option("--yaw-bias-deg-per-m", bias, "Yaw bias of the odometry")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  adit::make_figure(folder, bias);
  return 0;
} catch (const std::exception& error) {
  std::cerr << "figure4: " << error.what() << "\n";
  return 2;
}
