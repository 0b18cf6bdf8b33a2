// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// relations_table [--runs N]: what scan matching makes of every recording that is there, as two
// tables in Markdown: against hand-verified relations, and against a path that is known otherwise.
#include <exception>
#include <iostream>
#include <string>

#include <CLI/CLI.hpp>

#include "tests/eval/benchmarks.hpp"
#include "tests/eval/mapping/evaluation.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tools/eval/path_error.hpp"
#include "tools/eval/relations.hpp"
#include "tools/sim/sample_run.hpp"

namespace adit {
namespace {

/// Relations that the trajectory does not cover count as they do for others: not at all.
void print_benchmark(const Benchmark& benchmark, bool use_odometry, int runs) {
  const auto log = find_laser_recording(benchmark.log);
  const auto relations = find_laser_recording(benchmark.relations);
  if (!log || !relations) return;
  const Evaluation run = evaluate(*log, use_odometry, runs);
  const RelationsScore score = score_relations(read_relations(*relations), run.odometry);
  const auto& t = score.translation_m;
  const auto& r = score.rotation_deg;
  std::cout << format("| %s, %d beams | %s | **%.3f** ± %.3f | %.3f | %.2f ± %.2f | %s | %s |",
                      benchmark.name, benchmark.beams, use_odometry ? "yes" : "no", t.mean,
                      t.standard_deviation, t.median, r.mean, r.standard_deviation,
                      benchmark.published, benchmark.scan_to_scan_icp)
            << format(" %zu | %zu | %zu | %.2f | %.1f |\n", run.scans, run.lost_scans, run.searched,
                      run.scan_ms, run.scan_p99_ms)
            << std::flush;
}

void print_relations_table(int runs) {
  std::cout << "| log | odometry | translation, mean ± sd (m) | median (m) | rotation (°) "
               "| published scan matching (m) | CSM chain (m) "
               "| scans | lost | searched | ms per scan | p99 |\n"
               "|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const Benchmark& benchmark : kBenchmarks) {
    for (const bool use_odometry : {true, false}) print_benchmark(benchmark, use_odometry, runs);
  }
}

void print_path(const std::string& name, bool use_odometry, const Evaluation& run,
                const Trajectory& reference) {
  const PathError error = path_error(run.odometry, reference);
  std::cout << format("| %s | %s | %.1f / %.1f | %.2f | %.2f | %.2f / %.2f | %.2f |", name.c_str(),
                      use_odometry ? "yes" : "no", path_length_m(run.odometry),
                      path_length_m(reference), error.rmse_m, error.farthest_m,
                      longest_step_m(run.odometry), longest_step_m(reference), error.step_m)
            << format(" %zu, %.1f m | %zu | %zu | %zu | %zu | %.2f | %.1f |\n",
                      run.degenerate_stretches, run.degenerate_m, run.degenerate, run.scans,
                      run.lost_scans, run.searched, run.scan_ms, run.scan_p99_ms)
            << std::flush;
}

void print_sample(bool half_degree, bool use_odometry, int runs) {
  const test::ScratchFolder scratch;
  SampleRun sample({.beams = half_degree ? 361 : 181});
  write_sample_log(sample, scratch / "mine.lcmlog");
  print_path(half_degree ? "sample mine, 361 beams" : "sample mine, 181 beams", use_odometry,
             evaluate(scratch / "mine.lcmlog", use_odometry, runs), sample.truth());
}

void print_corrected(const Corrected& recording, int runs) {
  const auto log = find_laser_recording(recording.log);
  if (!log) return;
  print_path(format("%s, %d beams", recording.name, recording.beams), false,
             evaluate(*log, false, runs), poses_of(*log));
}

void print_paths_table(int runs) {
  std::cout << "| log | odometry | path, found / reference (m) | RMSE (m) | farthest (m) "
               "| longest step, found / reference (m) | largest error of a step (m) "
               "| degenerate stretches | scans in them | scans | lost | searched "
               "| ms per scan | p99 |\n"
               "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const bool half_degree : {false, true}) {
    for (const bool use_odometry : {true, false}) print_sample(half_degree, use_odometry, runs);
  }
  for (const Corrected& recording : kCorrected) print_corrected(recording, runs);
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) try {
  CLI::App app("Scan matching over all recordings, as tables in Markdown");
  int runs = 5;
  app.add_option("--runs", runs, "of each log; times are medians of these")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  adit::print_relations_table(runs);
  std::cout << "\n";
  adit::print_paths_table(runs);
  return 0;
} catch (const std::exception& error) {
  std::cerr << "relations_table: " << error.what() << "\n";
  return 2;
}
