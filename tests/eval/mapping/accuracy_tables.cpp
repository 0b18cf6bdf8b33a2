// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/eval/mapping/accuracy_tables.hpp"

#include <array>
#include <exception>
#include <filesystem>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <variant>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "common/geometry/order_statistics.hpp"
#include "procs/mapping/map_journal.hpp"
#include "tests/eval/markdown.hpp"
#include "tests/support/recordings.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tools/carmen/carmen_reader.hpp"
#include "tools/map/map_run.hpp"
#include "tools/sim/sample_run.hpp"

namespace adit {
namespace {

constexpr std::array kBenchmarks = {
    Benchmark{"CSAIL", "csail_raw.log.gz", "csail.relations", 361, "0.106 ± 0.325", "0.414 ± 1.32"},
    Benchmark{"Intel", "intel_raw.log.gz", "intel.relations", 180, "0.220 ± 0.296", "0.798 ± 1.07"},
    Benchmark{"FR079", "fr079_chain.log.gz", "fr079.relations", 360, "0.258 ± 0.427",
              "0.672 ± 1.32"},
};

/// A recording whose pose fields hold a path corrected by loop closing. Its odometry is the same
/// path, so that it is evaluated with the laser only.
struct CorrectedRecording {
  const char* name;
  const char* log;
  int beams;
};

constexpr std::array kCorrectedRecordings = {
    CorrectedRecording{"Acapulco", "acapulco_scans.log.gz", 181},
    CorrectedRecording{"Seattle", "seattle_scans.log.gz", 361}};

std::optional<std::filesystem::path> find_laser_recording(const char* name) {
  return test::find_recording(std::string("laser2d/") + name);
}

/// Poses of the log itself, without those of scans that repeat or step back in time.
Trajectory poses_of(const std::filesystem::path& log) {
  Trajectory poses;
  CarmenReader reader(log);
  while (const auto record = reader.next()) {
    const auto* scan = std::get_if<CarmenScan>(&*record);
    if (scan == nullptr) continue;
    if (!poses.empty() && scan->scan.utime <= poses.back().utime) continue;
    poses.push_back({scan->scan.utime, scan->T_log_laser});
  }
  return poses;
}

Evaluation read_results(const std::filesystem::path& folder) {
  const auto summary = nlohmann::json::parse(test::contents(folder / "summary.json"));
  Evaluation result;
  result.trajectory = read_tum(folder / "trajectory.tum");
  result.odometry = read_tum(folder / "odometry.tum");
  result.map = read_map_journal(folder / "map.journal");
  result.scans = result.odometry.size();
  result.lost_scans = summary.at("scans").at("lost");
  result.searched = summary.at("scans").at("searched");
  result.degenerate = summary.at("scans").at("degenerate");
  for (const auto& segment : summary.at("unobserved_segments")) {
    if (segment.at("kind") != "degenerate") continue;
    result.degenerate_segments += segment.at("intervals").get<std::size_t>();
    result.degenerate_m += segment.at("length_m").get<double>();
  }
  result.scan_ms = summary.at("ms_per_scan").at("mean");
  result.scan_p99_ms = summary.at("ms_per_scan").at("p99");
  result.loop_closures = summary.at("map").at("loop_closures").at("accepted");
  result.revised_decisions = summary.at("map").at("loop_closures").at("revised");
  result.local_map_ms = summary.at("ms_per_local_map").at("mean");
  result.local_map_max_ms = summary.at("ms_per_local_map").at("max");
  result.local_map_kbytes =
      1e-3 * summary.at("map").at("bytes_per_local_map").at("serialised").get<double>();
  return result;
}

/// Runs scan matching and mapping `runs` times on a log, with a temporary output folder. Throws
/// std::runtime_error if two runs give different trajectories.
Evaluation evaluate(const std::filesystem::path& log, bool use_odometry, int runs) {
  const test::ScratchFolder scratch;
  Evaluation result;
  std::vector<double> means_ms;
  std::vector<double> p99s_ms;
  std::vector<double> local_maps_ms;
  std::vector<double> local_maps_max_ms;
  for (int i = 0; i < runs; ++i) {
    run_map({log, scratch / "run", {}, use_odometry, {}, false}, [](const std::string&, double) {});
    const Evaluation run = read_results(scratch / "run");
    if (i == 0) result = run;
    if (run.trajectory != result.trajectory) {
      throw std::runtime_error(log.string() + ": two runs give different trajectories");
    }
    means_ms.push_back(run.scan_ms);
    p99s_ms.push_back(run.scan_p99_ms);
    local_maps_ms.push_back(run.local_map_ms);
    local_maps_max_ms.push_back(run.local_map_max_ms);
  }
  result.scan_ms = median(means_ms);
  result.scan_p99_ms = median(p99s_ms);
  result.local_map_ms = median(local_maps_ms);
  result.local_map_max_ms = median(local_maps_max_ms);
  return result;
}

void print_row(const char* name, int beams, bool use_odometry, const std::string& columns) {
  std::cout << format("| %s, %d beams | %s |", name, beams, use_odometry ? "yes" : "no") << columns
            << std::endl;
}

void print_relations_table(const AccuracyTables& tables, int runs) {
  print_heading("| log | odometry " + tables.relations_heading);
  for (const Benchmark& benchmark : kBenchmarks) {
    const auto log = find_laser_recording(benchmark.log);
    const auto relations = find_laser_recording(benchmark.relations);
    if (!log || !relations) continue;
    for (const bool use_odometry : {true, false}) {
      print_row(benchmark.name, benchmark.beams, use_odometry,
                tables.relations_row(benchmark, read_relations(*relations),
                                     evaluate(*log, use_odometry, runs)));
    }
  }
}

void print_path_table(const AccuracyTables& tables, int runs) {
  print_heading("| log | odometry " + tables.path_heading);
  for (const int beams : {181, 361}) {
    const test::ScratchFolder scratch;
    SampleRun sample({.beams = beams});
    write_sample_log(sample, scratch / "mine.lcmlog");
    for (const bool use_odometry : {true, false}) {
      print_row(
          "sample mine", beams, use_odometry,
          tables.path_row(evaluate(scratch / "mine.lcmlog", use_odometry, runs), sample.truth()));
    }
  }
  for (const CorrectedRecording& recording : kCorrectedRecordings) {
    const auto log = find_laser_recording(recording.log);
    if (!log) continue;
    print_row(recording.name, recording.beams, false,
              tables.path_row(evaluate(*log, false, runs), poses_of(*log)));
  }
}

}  // namespace

int print_accuracy_tables(int argc, char** argv, const AccuracyTables& tables) try {
  CLI::App app(tables.description);
  int runs = tables.default_runs;
  app.add_option("--runs", runs, "Runs of each log; times are medians of these")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  print_relations_table(tables, runs);
  std::cout << "\n";
  print_path_table(tables, runs);
  return 0;
} catch (const std::exception& error) {
  std::cerr << tables.program << ": " << error.what() << "\n";
  return 2;
}

}  // namespace adit
