// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Time to insert a 3D scan of 240 × 361 beams into an octree with cells of 0.1 m: with OctoMap,
// from one origin or from the origin of each line, and with volume_map. Times are CPU times, which
// hardly depend on other processes.
#include <algorithm>

#include <benchmark/benchmark.h>
#include <octomap/OcTree.h>

#include "procs/volume_map/occupancy_tree.hpp"
#include "procs/volume_map/scan_cells.hpp"
#include "procs/volume_map/volume_map.hpp"
#include "sim/sweep/tilt_sweep.hpp"
#include "sim/world/build_world.hpp"
#include "sim/world/plan/tunnel_line.hpp"
#include "sim/world/world_file.hpp"
#include "tests/support/worlds/box_tunnel.hpp"

namespace adit {
namespace {

constexpr double kRangeMaxM = 20.0;

Cloud make_scan() {
  const WorldDescription description = find_world("mathies");
  const Site site(build_world(description));
  const auto tunnels = tunnel_lines(description.plan);
  const auto [p_world, heading_rad] = find_tunnel(tunnels, "main", "bench").at(50.0);
  return tilt_sweep(site, level_on_floor(site.world(), {p_world.x(), p_world.y(), heading_rad}));
}

/// A hall of 16 × 4 m, with longer beams and more cells than a tunnel.
Cloud make_scan_of_hall() {
  const Site site(box_tunnel({40.0, 16.0, 4.0}));
  return tilt_sweep(site, level_on_floor(site.world(), {}));
}

/// The scan of the tunnel or the hall, by the second argument of a benchmark.
const Cloud& scan(const benchmark::State& state) {
  static const Cloud tunnel = make_scan();
  static const Cloud hall = make_scan_of_hall();
  return state.range(1) == 0 ? tunnel : hall;
}

/// Cell size [m], from the first argument of a benchmark [mm].
double cell_m(const benchmark::State& state) { return 1e-3 * static_cast<double>(state.range(0)); }

octomap::point3d octo(const Eigen::Vector3f& p) { return {p.x(), p.y(), p.z()}; }

octomap::Pointcloud points_of(const CloudLine& line) {
  octomap::Pointcloud points;
  for (const Eigen::Vector3f& p : line.points) points.push_back(octo(p));
  return points;
}

/// The common use of OctoMap: one origin for all points, here that of the middle line.
void octomap_one_origin(benchmark::State& state, bool discretize) {
  const Cloud& cloud = scan(state);
  octomap::Pointcloud points;
  for (const CloudLine& line : cloud.lines) points.push_back(points_of(line));
  const auto origin = octo(cloud.lines[cloud.lines.size() / 2].origin);
  for (auto _ : state) {
    octomap::OcTree tree(cell_m(state));
    tree.insertPointCloud(points, origin, kRangeMaxM, false, discretize);
    benchmark::DoNotOptimize(tree);
  }
  state.counters["points"] = static_cast<double>(cloud.points());
}

struct Update {
  octomap::KeySet free;
  octomap::KeySet occupied;
};

/// With the origin of each line; cells occupied by any line are not free.
Update update_of(octomap::OcTree& tree, const Cloud& cloud, bool discretize) {
  Update all;
  for (const CloudLine& line : cloud.lines) {
    Update line_update;
    const auto points = points_of(line);
    const auto origin = octo(line.origin);
    if (discretize) {
      tree.computeDiscreteUpdate(points, origin, line_update.free, line_update.occupied,
                                 kRangeMaxM);
    } else {
      tree.computeUpdate(points, origin, line_update.free, line_update.occupied, kRangeMaxM);
    }
    all.free.insert(line_update.free.begin(), line_update.free.end());
    all.occupied.insert(line_update.occupied.begin(), line_update.occupied.end());
  }
  for (const auto& key : all.occupied) all.free.erase(key);
  return all;
}

/// Number of keys that are in exactly one of the sets.
double count_different(const octomap::KeySet& a, const octomap::KeySet& b) {
  const auto missing = [](const octomap::KeySet& keys) {
    return [&keys](const octomap::OcTreeKey& key) { return keys.find(key) == keys.end(); };
  };
  return static_cast<double>(std::count_if(a.begin(), a.end(), missing(b)) +
                             std::count_if(b.begin(), b.end(), missing(a)));
}

void octomap_each_origin(benchmark::State& state, bool discretize) {
  const Cloud& cloud = scan(state);
  Update update;
  for (auto _ : state) {
    octomap::OcTree tree(cell_m(state));
    update = update_of(tree, cloud, discretize);
    for (const auto& key : update.free) tree.updateNode(key, false);
    for (const auto& key : update.occupied) tree.updateNode(key, true);
    state.counters["nodes"] = static_cast<double>(tree.size());
  }
  octomap::OcTree tree(cell_m(state));
  const Update exact = update_of(tree, cloud, false);
  state.counters["free"] = static_cast<double>(update.free.size());
  state.counters["other_free"] = count_different(update.free, exact.free);
}

ScanCells cells_of(const Cloud& cloud, double cell_m) {
  ScanCells cells;
  for (const CloudLine& line : cloud.lines) {
    add_line(VoxelGrid(cell_m), line, kRangeMaxM, cells);
  }
  return cells;
}

void adit_each_origin(benchmark::State& state) {
  const Cloud& cloud = scan(state);
  for (auto _ : state) {
    OccupancyTree tree(cell_m(state));
    const ScanCells cells = cells_of(cloud, cell_m(state));
    tree.update(runs_of(cells.free, cells.occupied));
    state.counters["nodes"] = static_cast<double>(tree.nodes());
  }
}

/// The part of adit_each_origin that follows the beams.
void adit_beams(benchmark::State& state) {
  const Cloud& cloud = scan(state);
  for (auto _ : state) benchmark::DoNotOptimize(cells_of(cloud, cell_m(state)));
}

/// Total cost of a scan: the tree, the stored points, and the published stream.
void sub_volume(benchmark::State& state) {
  const Cloud& cloud = scan(state);
  for (auto _ : state) {
    SubVolume volume{{.cell_m = cell_m(state)}};
    volume.insert(cloud, {});
    state.counters["octree_kB"] = 1e-3 * static_cast<double>(volume.octree().size());
    state.counters["points"] = static_cast<double>(volume.points().size());
  }
}

/// Cost of a change of the pose graph that moves a hundred sub-volumes.
void graph_change(benchmark::State& state) {
  VolumeMap map{VolumeMapParams{}};
  Cloud cloud;
  for (int i = 0; i < 100; ++i) {
    cloud.T_odom_level.x = 20.0 * i;
    map.add(cloud);
  }
  map.set_graph({0, 1, {{}}, {}});
  map.set_correction({0, 1, 0, 0, {}, {}});
  for (auto _ : state) map.set_graph({0, 1, {{1.0, 2.0, 0.1}}, {}});
}

void arguments(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"cell_mm", "hall"})->Unit(benchmark::kMillisecond);
  benchmark->Args({100, 0})->Args({50, 0})->Args({100, 1});
}

BENCHMARK_CAPTURE(octomap_one_origin, exact, false)->Apply(arguments);
BENCHMARK_CAPTURE(octomap_one_origin, discretised, true)->Apply(arguments);
BENCHMARK_CAPTURE(octomap_each_origin, exact, false)->Apply(arguments);
BENCHMARK_CAPTURE(octomap_each_origin, discretised, true)->Apply(arguments);
BENCHMARK(adit_each_origin)->Apply(arguments);
BENCHMARK(adit_beams)->Apply(arguments);
BENCHMARK(sub_volume)->Apply(arguments);
BENCHMARK(graph_change)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace adit
