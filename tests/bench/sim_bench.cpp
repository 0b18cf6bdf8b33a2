// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// How much faster than real time the simulator is, in a mine of about a million triangles. Times
// are of the processor, so that others on the machine count little.
#include <cmath>
#include <numbers>

#include <benchmark/benchmark.h>

#include "sim/laser/laser_model.hpp"
#include "sim/mesh/ray_scene.hpp"
#include "tests/support/rough_mine.hpp"

namespace adit {
namespace {

constexpr double kLasers = 2.0;

const TriangleMesh& mesh() {
  static const TriangleMesh mine = rough_mine();
  return mine;
}

const RayScene& scene() {
  static const RayScene made(mesh());
  return made;
}

/// Along a drift at 0.5 m/s, nodding as a laser does that makes a scan in three dimensions.
Eigen::Isometry3d pose(double seconds) {
  const double along_m = std::fmod(10.0 + 0.5 * seconds, 110.0);
  return Eigen::Translation3d(along_m, 61.5, 0.7) *
         Eigen::AngleAxisd(0.4 * std::sin(seconds), Eigen::Vector3d::UnitY());
}

void scans(benchmark::State& state) {
  LaserParams params;
  params.subrays = static_cast<int>(state.range(0));
  LaserModel laser(scene(), params, 1);
  const double period_s = params.timing.scan_period_s(params.angle_step_rad());
  double now_s = 0.0;
  for (auto _ : state) {
    const auto scan = laser.measure([&](double s) { return pose(now_s + s); }, 0);
    benchmark::DoNotOptimize(scan.ranges_m.data());
    now_s += 7.0 * period_s;  // so that a short run, too, sees much of the mine
  }
  const auto n = static_cast<double>(state.iterations());
  state.counters["times_real_time"] =
      benchmark::Counter(n * period_s / kLasers, benchmark::Counter::kIsRate);
  state.counters["triangles"] = static_cast<double>(mesh().triangles.size());
}

/// From triangles in memory to a scene that is ready.
void scene_of_a_mesh(benchmark::State& state) {
  for (auto _ : state) {
    const RayScene made(mesh());
    benchmark::DoNotOptimize(&made);
  }
}

BENCHMARK(scans)->Arg(1)->Arg(9)->Unit(benchmark::kMicrosecond);
BENCHMARK(scene_of_a_mesh)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace adit
