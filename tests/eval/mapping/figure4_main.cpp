// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// figure4 FOLDER [--yaw-bias-deg-per-m B]: draws the map of the drive through two parallel
// corridors before and after the revision at the corner, and prints a table row in Markdown
// (docs/results/parallel_corridors.md).
#include <algorithm>
#include <ctime>
#include <exception>
#include <filesystem>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
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

/// A step in which loop closures were revoked, with the graphs and the errors of the newest local
/// map before and after it.
struct Revision {
  MapUpdate update;
  MapGraph before;
  MapGraph after;
  double before_m = 0.0;
  double after_m = 0.0;
  double seconds = 0.0;

  [[nodiscard]] double gain_m() const { return before_m - after_m; }
};

/// Drives to the end. Returns the revision that corrected the newest local map most.
std::optional<Revision> drive_to_the_end(test::ParallelDrive& drive) {
  std::optional<Revision> best;
  Revision step;
  while (true) {
    const auto start = std::clock();
    auto update = drive.next();
    if (!update) return best;
    step.seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    step.after = drive.mapping().graph();
    step.after_m = drive.newest_error_m();
    const bool is_revision = test::revoked(*update) > 0;
    step.update = std::move(*update);
    if (is_revision && (!best || step.gain_m() > best->gain_m())) best = step;
    step.before = std::move(step.after);
    step.before_m = step.after_m;
  }
}

void print_row(double bias, const Revision& revision, const PathError& end) {
  std::cout << fmt::format(
      "| {:.3f} | {} | {} | {} | {:.1f} | {:.2f} | {:.0f} | {:.2f} | {:.2f} |\n", bias,
      revision.update.map.id, test::revoked(revision.update), test::newly_accepted(revision.update),
      revision.before_m, revision.after_m, 1e3 * revision.seconds, end.rmse_m, end.farthest_m);
}

void make_figure(const std::filesystem::path& folder, double bias) {
  test::ParallelDrive drive(bias);
  const std::optional<Revision> revision = drive_to_the_end(drive);
  const PathError end = drive.error();
  if (!revision) {
    throw std::runtime_error(
        fmt::format("no loop closure was revoked; at the end of the drive RMSE {:.2f} m, largest "
                    "error {:.2f} m",
                    end.rmse_m, end.farthest_m));
  }
  const std::vector<LoopClosure> revoked = revoked_loop_closures(revision->update);
  const int first = revoked.front().newer_map;
  const std::vector<LocalMap> maps = drive.mapping().local_maps().load_all();
  draw(maps, {extended(revision->before, revision->update.map), {}, first},
       "Before revision: in the wrong corridor", folder / "parallel_corridors_before.png");
  draw(maps, {revision->after, revoked, first}, "After revision: in the right corridor",
       folder / "parallel_corridors_after.png");
  print_row(bias, *revision, end);
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
