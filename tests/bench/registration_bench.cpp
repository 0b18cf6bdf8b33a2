// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Times of the steps of scan matching for a scan in the sample mine and a reference of the
// preceding 10 m. The argument is the number of beams.
#include <benchmark/benchmark.h>

#include "common/registration/correlative_search.hpp"
#include "common/registration/point_to_line.hpp"
#include "tools/eval/trajectory.hpp"
#include "tools/sim/sample_run.hpp"

namespace adit {
namespace {

constexpr double kLengthM = 10.0;
const Pose2 kPredictionError{0.08, -0.05, 0.04};

/// The last scan of a short drive, and the others as reference, all at their true poses.
struct Place {
  explicit Place(std::int64_t beams) {
    SampleRun run({.beams = static_cast<int>(beams), .length_max_m = kLengthM});
    while (const auto reading = run.next()) {
      if (!points.empty()) reference.insert(points, T_world_body, 0.0);
      scan = reading->scan;
      points = surface_points(scan, mount, {});
      T_world_body = run.truth().back().pose;
    }
  }

  LaserMount mount;
  LaserScan scan;
  std::vector<SurfacePoint> points;
  Pose2 T_world_body;
  SurfelMap reference{SurfelMapParams{}};
};

void bench_surface_points(benchmark::State& state) {
  const Place place(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(surface_points(place.scan, place.mount, {}));
}

void bench_match_point_to_line(benchmark::State& state) {
  const Place place(state.range(0));
  const Pose2 start = place.T_world_body * kPredictionError;
  PointToLineResult result;
  for (auto _ : state) {
    result = match_point_to_line(place.points, place.reference, start, {start, {}}, {});
    benchmark::DoNotOptimize(result);
  }
  const Pose2 error = between(place.T_world_body, result.T_odom_body);
  state.counters["iterations"] = result.iterations;
  state.counters["error_mm"] = 1e3 * error.translation().norm();
}

void search(benchmark::State& state, const SearchWindow& window, double coarseness) {
  constexpr int kPeaks = 3;
  const Place place(state.range(0));
  const Pose2 centre = place.T_world_body * kPredictionError;
  CorrelativeSearchParams params;
  params.cell_m *= coarseness;
  params.angle_step_rad *= coarseness;
  std::vector<CorrelationPeak> peaks;
  for (auto _ : state) {
    peaks = search_correlation(place.points, place.reference, centre, window, kPeaks, params);
    benchmark::DoNotOptimize(peaks);
  }
  if (peaks.empty()) return;
  const Pose2 error = between(place.T_world_body, peaks.front().T_odom_body);
  state.counters["error_mm"] = 1e3 * error.translation().norm();
}

void bench_search_correlation(benchmark::State& state) { search(state, {1.0, 0.7}, 1.0); }
void bench_search_correlation_wide(benchmark::State& state) { search(state, {2.5, 2.5}, 2.0); }

BENCHMARK(bench_surface_points)->Arg(181)->Arg(361)->Unit(benchmark::kMicrosecond);
BENCHMARK(bench_match_point_to_line)->Arg(181)->Arg(361)->Unit(benchmark::kMicrosecond);
BENCHMARK(bench_search_correlation)->Arg(181)->Arg(361)->Unit(benchmark::kMicrosecond);
BENCHMARK(bench_search_correlation_wide)->Arg(181)->Arg(361)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace adit
