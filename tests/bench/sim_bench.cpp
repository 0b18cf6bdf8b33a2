// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Speed of the simulator relative to real time in a built-in mine of more than a million triangles,
// and the time to load the mine. Times are CPU times, which hardly depend on other processes.
#include <cmath>

#include <benchmark/benchmark.h>

#include "sim/laser/laser_model.hpp"
#include "sim/simulation/simulation.hpp"
#include "sim/world/build_world.hpp"
#include "sim/world/plan/tunnel_line.hpp"
#include "sim/world/world_file.hpp"

namespace adit {
namespace {

constexpr double kLasers = 2.0;
constexpr double kSpacingM = 0.5;  // between the poses of a tour

WorldDescription description() { return find_world("bruceton"); }

const Site& site() {
  static const Site bruceton(build_world(description()));
  return bruceton;
}

void count_triangles(benchmark::State& state) {
  state.counters["triangles"] = static_cast<double>(site().world().mesh.triangles.size());
}

/// Simulated time divided by CPU time.
benchmark::Counter times_real_time(double simulated_s) {
  return {simulated_s, benchmark::Counter::kIsRate};
}

/// Poses of a tilting laser along the centre line of every tunnel.
std::vector<Eigen::Isometry3d> tour() {
  std::vector<Eigen::Isometry3d> poses;
  for (const TunnelLine& tunnel : tunnel_lines(description().plan)) {
    for (double s_m = 1.0; s_m < tunnel.length_m() - 1.0; s_m += kSpacingM) {
      const auto [p_world, heading_rad] = tunnel.at(s_m);
      const double floor_m = site().world().truth.floor_height(p_world).value_or(0.0);
      poses.push_back(Eigen::Translation3d(p_world.x(), p_world.y(), floor_m + 0.7) *
                      Eigen::AngleAxisd(heading_rad, Eigen::Vector3d::UnitZ()) *
                      Eigen::AngleAxisd(0.4 * std::sin(s_m), Eigen::Vector3d::UnitY()));
    }
  }
  return poses;
}

void scans_of_two_lasers(benchmark::State& state) {
  LaserParams params;
  params.subrays = static_cast<int>(state.range(0));
  LaserModel laser(site().scene(), params, 1);
  const double period_s = params.timing.scan_period_s(params.angle_step_rad());
  const std::vector<Eigen::Isometry3d> poses = tour();
  std::size_t i = 0;
  for (auto _ : state) {
    const auto scan = laser.measure([&](double) { return poses[i]; }, 0);
    benchmark::DoNotOptimize(scan.ranges_m.data());
    i = (i + 97) % poses.size();  // covers the complete mine also in a short run
  }
  const auto scans = static_cast<double>(state.iterations());
  state.counters["times_real_time"] = times_real_time(scans * period_s / kLasers);
  count_triangles(state);
}

/// A robot that drives along a tunnel with both lasers tilting, with all its messages.
void full_robot(benchmark::State& state) {
  SimulationParams params;
  params.laser.subrays = static_cast<int>(state.range(0));
  Simulation simulation(site(), params, 1, 0);
  for (auto _ : state) {
    const std::int64_t now = simulation.utime();
    const double tilt_rad = now / 2'000'000 % 2 == 0 ? 0.4 : -0.4;
    simulation.command(SimLaser::kFront, TiltCommand{now, tilt_rad, 0.5});
    simulation.command(SimLaser::kRear, TiltCommand{now, -tilt_rad, 0.5});
    const double speed_m_s = now / 40'000'000 % 2 == 0 ? 0.5 : -0.5;  // forward and reverse
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

/// From the world description to the site with its ray scene.
void load(benchmark::State& state) {
  for (auto _ : state) {
    const Site loaded(build_world(description()));
    benchmark::DoNotOptimize(&loaded);
  }
  count_triangles(state);
}

/// The part of load() that builds the ray scene.
void build_ray_scene(benchmark::State& state) {
  for (auto _ : state) {
    const RayScene scene(site().world().mesh);
    benchmark::DoNotOptimize(&scene);
  }
}

BENCHMARK(scans_of_two_lasers)->Arg(1)->Arg(9)->Unit(benchmark::kMicrosecond);
BENCHMARK(full_robot)->Arg(1)->Arg(9)->Unit(benchmark::kMicrosecond);
BENCHMARK(load)->Unit(benchmark::kMillisecond);
BENCHMARK(build_ray_scene)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace adit
