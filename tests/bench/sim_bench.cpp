// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// How much faster than real time the simulator is, in a mine of a million triangles with all that
// stands in one, and how long that takes to load. Times are of the processor, so that others on the
// machine count little.
#include <cmath>

#include <benchmark/benchmark.h>

#include "sim/laser/laser_model.hpp"
#include "sim/simulation/simulation.hpp"
#include "sim/world/build_world.hpp"

namespace adit {
namespace {

constexpr double kLasers = 2.0;
constexpr double kEntryM = 150.0;
constexpr int kEntries = 10;

/// Rooms and pillars: entries along x, 12 m apart, of which the middle one has rails and posts.
WorldDescription description() {
  WorldDescription mine;
  mine.name = "bench";
  mine.T_world_start = {5.0, 48.0, 0.0};
  PanelDescription panel;
  panel.name = "panel";
  panel.entries = kEntries;
  panel.crosscuts = 7;
  panel.length_m = kEntryM;
  mine.plan.panels = {panel};
  for (int entry = 0; entry < kEntries; ++entry) {
    const std::string drift = "panel_entry_" + std::to_string(entry);
    RailsDescription rails;
    rails.drift = drift;
    rails.to_m = kEntryM;
    mine.props.rails.push_back(rails);
    PostsDescription posts;
    posts.drift = drift;
    posts.from_m = 2.0;
    posts.to_m = kEntryM - 2.0;
    posts.both_sides = true;
    mine.props.posts.push_back(posts);
  }
  return mine;
}

const Site& site() {
  static const Site made(build_world(description()));
  return made;
}

void count_triangles(benchmark::State& state) {
  state.counters["triangles"] = static_cast<double>(site().world().mesh.triangles.size());
}

/// How often real time goes into the time that was taken.
benchmark::Counter times_real_time(double simulated_s) {
  return {simulated_s, benchmark::Counter::kIsRate};
}

/// Along a drift at 0.5 m/s, nodding as a laser does that makes a scan in three dimensions.
Eigen::Isometry3d pose(double seconds) {
  const double along_m = std::fmod(5.0 + 0.5 * seconds, kEntryM - 5.0);
  return Eigen::Translation3d(along_m, 48.0, 0.7) *
         Eigen::AngleAxisd(0.4 * std::sin(seconds), Eigen::Vector3d::UnitY());
}

void scans_of_two_lasers(benchmark::State& state) {
  LaserParams params;
  params.subrays = static_cast<int>(state.range(0));
  LaserModel laser(site().scene(), params, 1);
  const double period_s = params.timing.scan_period_s(params.angle_step_rad());
  double now_s = 0.0;
  for (auto _ : state) {
    const auto scan = laser.measure([&](double s) { return pose(now_s + s); }, 0);
    benchmark::DoNotOptimize(scan.ranges_m.data());
    now_s += 7.0 * period_s;  // so that a short run, too, sees much of the mine
  }
  const auto scans = static_cast<double>(state.iterations());
  state.counters["times_real_time"] = times_real_time(scans * period_s / kLasers);
  count_triangles(state);
}

/// A robot that drives along a drift and nods with both lasers, and all it says.
void whole_robot(benchmark::State& state) {
  SimulationParams params;
  params.laser.subrays = static_cast<int>(state.range(0));
  Simulation simulation(site(), params, 1, 0);
  for (auto _ : state) {
    const std::int64_t now = simulation.utime();
    const double tilt_rad = now / 2'000'000 % 2 == 0 ? 0.4 : -0.4;
    simulation.command(SimLaser::kFront, TiltCommand{now, tilt_rad, 0.5});
    simulation.command(SimLaser::kRear, TiltCommand{now, -tilt_rad, 0.5});
    const double speed_m_s = now / 60'000'000 % 2 == 0 ? 0.5 : -0.5;  // there and back
    simulation.command(DriveCommand{now, speed_m_s, 0.0});
    benchmark::DoNotOptimize(simulation.step().size());
  }
  if (!simulation.state().failure.empty()) {
    return state.SkipWithError(simulation.state().failure.c_str());
  }
  state.counters["times_real_time"] =
      times_real_time(static_cast<double>(simulation.utime()) * 1e-6);
  count_triangles(state);
}

/// From the description to a site that is ready.
void load(benchmark::State& state) {
  for (auto _ : state) {
    const Site made(build_world(description()));
    benchmark::DoNotOptimize(&made);
  }
  count_triangles(state);
}

/// Of which this is for the ray casting.
void scene_of_a_mesh(benchmark::State& state) {
  for (auto _ : state) {
    const RayScene made(site().world().mesh);
    benchmark::DoNotOptimize(&made);
  }
}

BENCHMARK(scans_of_two_lasers)->Arg(1)->Arg(9)->Unit(benchmark::kMicrosecond);
BENCHMARK(whole_robot)->Arg(1)->Arg(9)->Unit(benchmark::kMicrosecond);
BENCHMARK(load)->Unit(benchmark::kMillisecond);
BENCHMARK(scene_of_a_mesh)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace adit
