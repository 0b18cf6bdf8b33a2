// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Time of scan matching on complete logs. An iteration processes one log. The counters mean_ms and
// p99_ms are milliseconds per scan over all iterations, in CPU time of the thread, which does not
// depend on other processes.
#include <algorithm>
#include <filesystem>
#include <numeric>
#include <string>
#include <variant>
#include <vector>

#include <benchmark/benchmark.h>
#include <time.h>  // clock_gettime (POSIX)

#include "common/sensing/laser_scan.hpp"
#include "common/sensing/vehicle_readings.hpp"
#include "procs/scan_matching/scan_matching.hpp"
#include "tests/support/recordings.hpp"
#include "tools/carmen/carmen_reader.hpp"
#include "tools/sim/sample_run.hpp"

namespace adit {
namespace {

/// The readings of a log in memory, so that reading files is not measured.
using Readings = std::vector<std::variant<WheelOdometry, LaserScan>>;

/// The complete drive through the built-in world `sample`.
Readings sample_readings(int beams) {
  Readings readings;
  SampleRun run({.beams = beams});
  while (const auto reading = run.next()) {
    readings.emplace_back(reading->odometry);
    readings.emplace_back(reading->scan);
  }
  return readings;
}

/// A CARMEN log.
Readings recorded_readings(const std::filesystem::path& path) {
  Readings readings;
  CarmenReader reader(path);
  while (const auto record = reader.next()) {
    if (const auto* scan = std::get_if<CarmenScan>(&*record)) {
      readings.emplace_back(scan->scan);
    } else {
      readings.emplace_back(std::get<WheelOdometry>(*record));
    }
  }
  return readings;
}

enum class Odometry { kUsed, kIgnored };

double thread_cpu_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

void match_log(const Readings& readings, Odometry odometry, std::vector<double>& scan_ms) {
  ScanMatching scan_matching{ScanMatchingParams{}};
  for (const auto& reading : readings) {
    if (const auto* scan = std::get_if<LaserScan>(&reading)) {
      const double start_ms = thread_cpu_ms();
      benchmark::DoNotOptimize(scan_matching.add_scan(LaserId::kFront, *scan));
      scan_ms.push_back(thread_cpu_ms() - start_ms);
    } else if (odometry == Odometry::kUsed) {
      scan_matching.add(std::get<WheelOdometry>(reading));
    }
  }
}

void measure(benchmark::State& state, const Readings& readings, Odometry odometry) {
  std::vector<double> scan_ms;
  for (auto _ : state) match_log(readings, odometry, scan_ms);
  const auto n = static_cast<double>(scan_ms.size());
  const auto p99 = scan_ms.begin() + static_cast<std::ptrdiff_t>(0.99 * (n - 1.0));
  std::nth_element(scan_ms.begin(), p99, scan_ms.end());
  state.counters["scans"] = n / static_cast<double>(state.iterations());
  state.counters["mean_ms"] = std::accumulate(scan_ms.begin(), scan_ms.end(), 0.0) / n;
  state.counters["p99_ms"] = *p99;
}

void match_sample(benchmark::State& state, int beams, Odometry odometry) {
  measure(state, sample_readings(beams), odometry);
}

void match_recording(benchmark::State& state, const std::string& name, Odometry odometry) {
  const auto path = test::find_recording("laser2d/" + name);
  if (!path) return state.SkipWithError("recording not found; set ADIT_DATA");
  measure(state, recorded_readings(*path), odometry);
}

#define ADIT_BENCH_LOG(function, name, log)                               \
  BENCHMARK_CAPTURE(function, name##_with_odometry, log, Odometry::kUsed) \
      ->Unit(benchmark::kMillisecond);                                    \
  BENCHMARK_CAPTURE(function, name##_laser_only, log, Odometry::kIgnored) \
      ->Unit(benchmark::kMillisecond)

ADIT_BENCH_LOG(match_sample, mine_181_beams, 181);
ADIT_BENCH_LOG(match_sample, mine_361_beams, 361);
ADIT_BENCH_LOG(match_recording, intel_180_beams, "intel_raw.log.gz");
ADIT_BENCH_LOG(match_recording, csail_361_beams, "csail_raw.log.gz");
ADIT_BENCH_LOG(match_recording, fr079_360_beams, "fr079_chain.log.gz");

}  // namespace
}  // namespace adit
