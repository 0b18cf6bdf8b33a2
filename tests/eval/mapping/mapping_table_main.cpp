// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// mapping_table [--runs N]: accuracy and time of mapping on all recordings, compared with scan
// matching alone, as two tables in Markdown: errors by hand-verified relations, and errors by a
// reference path.
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "tests/eval/mapping/accuracy_tables.hpp"
#include "tests/eval/mapping/loop_closure_score.hpp"
#include "tests/eval/markdown.hpp"
#include "tools/eval/path_error.hpp"

namespace adit {
namespace {

constexpr std::int64_t kSecond = 1'000'000;
constexpr std::int64_t kShort = 5 * kSecond;  // without noticeable drift
constexpr std::int64_t kLoop = 60 * kSecond;

/// Mean translational error of the relations over less than `kShort`, and over more than `kLoop`.
std::string short_and_loop_errors(const std::vector<Relation>& relations, const Trajectory& path) {
  std::vector<Relation> short_relations;
  std::vector<Relation> loops;
  for (const Relation& relation : relations) {
    const std::int64_t apart = std::abs(relation.utime_2 - relation.utime_1);
    if (apart < kShort) short_relations.push_back(relation);
    if (apart > kLoop) loops.push_back(relation);
  }
  return format(" %.3f, %.3f |", score_relations(short_relations, path).translation_m.mean,
                score_relations(loops, path).translation_m.mean);
}

std::string errors(const std::vector<Relation>& relations, const Trajectory& path) {
  const RelationsScore score = score_relations(relations, path);
  const auto& t = score.translation_m;
  const auto& r = score.rotation_deg;
  return format(" %.3f ± %.3f | %.3f | %.2f ± %.2f |", t.mean, t.standard_deviation, t.median,
                r.mean, r.standard_deviation) +
         short_and_loop_errors(relations, path);
}

std::string costs(const Evaluation& run) {
  return format(" %zu | %.1f | %.1f | %.1f |", run.map.maps.size(), run.local_map_ms,
                run.local_map_max_ms, run.local_map_kbytes);
}

std::string relations_row(const Benchmark&, const std::vector<Relation>& relations,
                          const Evaluation& run) {
  const LoopClosureScore score = score_loop_closures(run.map, run.odometry, relations);
  return errors(relations, run.odometry) + errors(relations, run.trajectory) +
         format(" %zu | %zu | %zu / %zu | %zu / %zu, %.2f |", run.loop_closures,
                run.revised_decisions, score.right, score.evaluated, score.found, score.expected,
                score.recall()) +
         costs(run);
}

std::string path_row(const Evaluation& run, const Trajectory& reference) {
  const PathError scan_matching = path_error(run.odometry, reference);
  const PathError mapping = path_error(run.trajectory, reference);
  return format(" %.3f | %.3f | %.3f | %.3f | %zu | %zu |", scan_matching.rmse_m,
                scan_matching.farthest_m, mapping.rmse_m, mapping.farthest_m, run.loop_closures,
                run.revised_decisions) +
         costs(run);
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) {
  return adit::print_accuracy_tables(
      argc, argv,
      {.program = "mapping_table",
       .description = "Mapping on all recordings, as tables in Markdown",
       .default_runs = 3,
       .relations_heading =
           "| scan matching: translation, mean ± sd (m) | median (m) | rotation (°) "
           "| below 5 s, above 60 s (m) | mapping: translation, mean ± sd (m) | median (m) "
           "| rotation (°) | below 5 s, above 60 s (m) | accepted loop closures "
           "| decisions revised | right / judged | found / linked, recall "
           "| local maps | ms per local map, mean | max | kB per local map |",
       .relations_row = adit::relations_row,
       .path_heading = "| scan matching: RMSE (m) | largest error (m) | mapping: RMSE (m) "
                       "| largest error (m) | accepted loop closures | decisions revised "
                       "| local maps | ms per local map, mean | max | kB per local map |",
       .path_row = adit::path_row});
}
