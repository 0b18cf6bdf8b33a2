// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Time of the guard for one scan of 361 beams in a tunnel of 1.8 m width with its end ahead:
// localization of the scan, sweep of both arcs over both scans and the remembered obstacles beside
// the vehicle, and all other checks.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <benchmark/benchmark.h>

#include "procs/guard/guard.hpp"

namespace adit {
namespace {

constexpr std::int64_t kStart = 1'600'000'000'000'000;

GuardParams params() {
  GuardParams params;
  params.lasers.front.T_body_laser = {1.05, 0.0, 0.0};
  params.lasers.rear.T_body_laser = {-1.05, 0.0, std::numbers::pi};
  params.lasers.front.height_m = params.lasers.rear.height_m = 0.62;
  return params;
}

LaserScan tunnel_scan(double end_m) {
  LaserScan scan{0, {}, -std::numbers::pi / 2.0, std::numbers::pi / 360.0};
  for (int i = 0; i < 361; ++i) {
    const double bearing = scan.angle_min_rad + i * scan.angle_step_rad;
    const double wall_m = 0.9 / std::max(1e-6, std::abs(std::sin(bearing)));
    scan.ranges_m.push_back(
        static_cast<float>(std::min(wall_m, end_m / std::max(1e-6, std::cos(bearing)))));
  }
  return scan;
}

/// `end_m`: distance of the end of the tunnel from the laser.
void evaluate_scan(benchmark::State& state, double end_m) {
  Guard guard(params());
  LaserScan scan = tunnel_scan(end_m);
  std::int64_t now = kStart;
  Pose2 T_odom_body;
  for (auto _ : state) {
    now += 27'000;
    scan.utime = now;
    T_odom_body.x += 0.4 * 0.027;
    guard.receive_pose(T_odom_body, now, now);
    guard.receive(DriveCommand{now, 0.4, 0.3}, now);
    guard.receive(VehicleState{now, 0.4, -0.3, 1.0, false, false}, now);
    guard.receive(now / 27'000 % 2 == 0 ? LaserId::kFront : LaserId::kRear, scan, now);
    benchmark::DoNotOptimize(guard.evaluate(now));
  }
}

BENCHMARK_CAPTURE(evaluate_scan, far_from_end, 20.0)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(evaluate_scan, close_to_end, 0.4)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace adit
