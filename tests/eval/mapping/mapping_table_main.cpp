// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// mapping_table [--runs N]: what mapping makes of every recording that is there, beside scan
// matching alone, as two tables in Markdown: against hand-verified relations, and against a path
// that is known otherwise.
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "tests/eval/benchmarks.hpp"
#include "tests/eval/mapping/evaluation.hpp"
#include "tests/eval/mapping/loop_closure_score.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tools/eval/path_error.hpp"
#include "tools/eval/relations.hpp"
#include "tools/sim/sample_run.hpp"

namespace adit {
namespace {

std::string errors(const ErrorStatistics& metres, const ErrorStatistics& degrees) {
  return format(" %.3f ± %.3f | %.3f | %.2f ± %.2f |", metres.mean, metres.standard_deviation,
                metres.median, degrees.mean, degrees.standard_deviation);
}

constexpr std::int64_t kSecond = 1'000'000;
constexpr std::int64_t kShort = 5 * kSecond;  // nothing drifts over it
constexpr std::int64_t kLoop = 60 * kSecond;

/// Mean translational error of the relations over less than `kShort`, and over more than `kLoop`.
std::string short_and_loops(const std::vector<Relation>& relations, const Trajectory& path) {
  std::vector<Relation> brief;
  std::vector<Relation> loops;
  for (const Relation& relation : relations) {
    const std::int64_t apart = std::abs(relation.utime_2 - relation.utime_1);
    if (apart < kShort) brief.push_back(relation);
    if (apart > kLoop) loops.push_back(relation);
  }
  return format(" %.3f, %.3f |", score_relations(brief, path).translation_m.mean,
                score_relations(loops, path).translation_m.mean);
}

std::string costs(const Evaluation& run) {
  return format(" %zu | %.1f | %.1f | %.1f |\n", run.map.maps.size(), run.local_map_ms,
                run.local_map_max_ms, run.local_map_kbytes);
}

void print_benchmark(const Benchmark& benchmark, bool use_odometry, int runs) {
  const auto log = find_laser_recording(benchmark.log);
  const auto path = find_laser_recording(benchmark.relations);
  if (!log || !path) return;
  const Evaluation run = evaluate(*log, use_odometry, runs);
  const auto relations = read_relations(*path);
  const RelationsScore before = score_relations(relations, run.odometry);
  const RelationsScore after = score_relations(relations, run.trajectory);
  const LoopClosureScore loop_closures = score_loop_closures(run.map, run.odometry, relations);
  std::cout << format("| %s, %d beams | %s |", benchmark.name, benchmark.beams,
                      use_odometry ? "yes" : "no")
            << errors(before.translation_m, before.rotation_deg)
            << short_and_loops(relations, run.odometry)
            << errors(after.translation_m, after.rotation_deg)
            << short_and_loops(relations, run.trajectory)
            << format(" %zu | %zu | %zu / %zu | %zu / %zu, %.2f |", run.loop_closures,
                      run.replaced_decisions, loop_closures.right, loop_closures.evaluated,
                      loop_closures.found, loop_closures.expected, loop_closures.recall())
            << costs(run) << std::flush;
}

void print_relations_table(int runs) {
  std::cout << "| log | odometry | scan matching: translation, mean ± sd (m) | median (m) "
               "| rotation (°) | below 5 s, above 60 s (m) | mapping: translation, mean ± sd (m) "
               "| median (m) | rotation (°) | below 5 s, above 60 s (m) "
               "| closures in force | decisions revised | right / judged | found / linked, recall "
               "| local maps | ms per local map, mean | max | kB per local map |\n"
               "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const Benchmark& benchmark : kBenchmarks) {
    for (const bool use_odometry : {true, false}) print_benchmark(benchmark, use_odometry, runs);
  }
}

void print_path(const std::string& name, bool use_odometry, const Evaluation& run,
                const Trajectory& reference) {
  const PathError before = path_error(run.odometry, reference);
  const PathError after = path_error(run.trajectory, reference);
  std::cout << format("| %s | %s | %.3f | %.3f | %.3f | %.3f | %zu | %zu |", name.c_str(),
                      use_odometry ? "yes" : "no", before.rmse_m, before.farthest_m, after.rmse_m,
                      after.farthest_m, run.loop_closures, run.replaced_decisions)
            << costs(run) << std::flush;
}

void print_sample(const std::string& name, int beams, bool use_odometry, int runs) {
  const test::ScratchFolder scratch;
  SampleRun sample({.beams = beams});
  write_sample_log(sample, scratch / "mine.lcmlog");
  print_path(name, use_odometry, evaluate(scratch / "mine.lcmlog", use_odometry, runs),
             sample.truth());
}

void print_corrected(const Corrected& recording, int runs) {
  const auto log = find_laser_recording(recording.log);
  if (!log) return;
  print_path(format("%s, %d beams", recording.name, recording.beams), false,
             evaluate(*log, false, runs), poses_of(*log));
}

void print_paths_table(int runs) {
  std::cout << "| log | odometry | scan matching: RMSE (m) | farthest (m) | mapping: RMSE (m) "
               "| farthest (m) | closures in force | decisions revised | local maps "
               "| ms per local map, mean | max | kB per local map |\n"
               "|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const bool use_odometry : {true, false}) {
    print_sample("sample mine, 181 beams", 181, use_odometry, runs);
    print_sample("sample mine, 361 beams", 361, use_odometry, runs);
  }
  for (const Corrected& recording : kCorrected) print_corrected(recording, runs);
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) try {
  CLI::App app("Mapping over all recordings, as tables in Markdown");
  int runs = 3;
  app.add_option("--runs", runs, "of each log; times are medians of these")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  adit::print_relations_table(runs);
  std::cout << "\n";
  adit::print_paths_table(runs);
  return 0;
} catch (const std::exception& error) {
  std::cerr << "mapping_table: " << error.what() << "\n";
  return 2;
}
