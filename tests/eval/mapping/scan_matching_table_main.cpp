// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// scan_matching_table [--runs N]: accuracy and time of scan matching on all recordings, as two
// tables in Markdown: errors by hand-verified relations, and errors by a reference path.
#include <string>
#include <vector>

#include "tests/eval/mapping/accuracy_tables.hpp"
#include "tests/eval/markdown.hpp"
#include "tools/eval/path_error.hpp"

namespace adit {
namespace {

std::string costs(const Evaluation& run) {
  return format(" %zu | %zu | %zu | %.2f | %.1f |", run.scans, run.lost_scans, run.searched,
                run.scan_ms, run.scan_p99_ms);
}

/// Relations outside the trajectory are not counted, as in the published scores.
std::string relations_row(const Benchmark& benchmark, const std::vector<Relation>& relations,
                          const Evaluation& run) {
  const RelationsScore score = score_relations(relations, run.odometry);
  const auto& t = score.translation_m;
  const auto& r = score.rotation_deg;
  return format(" **%.3f** ± %.3f | %.3f | %.2f ± %.2f | %s | %s |", t.mean, t.standard_deviation,
                t.median, r.mean, r.standard_deviation, benchmark.published,
                benchmark.scan_to_scan_icp) +
         costs(run);
}

std::string path_row(const Evaluation& run, const Trajectory& reference) {
  const PathError error = path_error(run.odometry, reference);
  return format(" %.1f / %.1f | %.2f | %.2f | %.2f / %.2f | %.2f |", path_length_m(run.odometry),
                path_length_m(reference), error.rmse_m, error.farthest_m,
                longest_step_m(run.odometry), longest_step_m(reference), error.step_m) +
         format(" %zu, %.1f m | %zu |", run.degenerate_segments, run.degenerate_m, run.degenerate) +
         costs(run);
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) {
  return adit::print_accuracy_tables(
      argc, argv,
      {.program = "scan_matching_table",
       .description = "Scan matching on all recordings, as tables in Markdown",
       .default_runs = 5,
       .relations_heading = "| translation, mean ± sd (m) | median (m) | rotation (°) "
                            "| published scan matching (m) | CSM chain (m) "
                            "| scans | lost | searched | ms per scan | p99 |",
       .relations_row = adit::relations_row,
       .path_heading = "| path length, estimated / reference (m) | RMSE (m) | largest error (m) "
                       "| longest step, estimated / reference (m) | largest error of a step (m) "
                       "| degenerate segments | degenerate scans "
                       "| scans | lost | searched | ms per scan | p99 |",
       .path_row = adit::path_row});
}
