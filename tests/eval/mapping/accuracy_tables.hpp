// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "procs/mapping/mapping.hpp"
#include "tools/eval/relations.hpp"
#include "tools/eval/trajectory.hpp"

namespace adit {

/// A recording with relations, and the scores of other methods on it: mean ± standard deviation of
/// the translational error [m].
struct Benchmark {
  const char* name;
  const char* log;
  const char* relations;
  int beams;
  const char* published;         ///< scan matching with odometry, Kümmerle et al. 2009
  const char* scan_to_scan_icp;  ///< point-to-line ICP from scan to scan, without odometry
};

/// Results of several runs of `adit map` on one log.
struct Evaluation {
  Trajectory odometry;    ///< T_odom_body of scan matching
  Trajectory trajectory;  ///< T_map_body of mapping
  StoredMap map;
  std::size_t scans = 0;
  std::size_t lost_scans = 0;
  std::size_t searched = 0;    ///< scans for which the correlative search ran
  std::size_t degenerate = 0;  ///< scans that do not constrain one direction or more
  std::size_t degenerate_segments = 0;
  double degenerate_m = 0.0;          ///< total length of the degenerate segments
  double scan_ms = 0.0;               ///< mean per scan of a run, median of the runs
  double scan_p99_ms = 0.0;           ///< 99th percentile per scan of a run, median of the runs
  std::size_t loop_closures = 0;      ///< accepted at the end
  std::size_t revised_decisions = 0;  ///< of data association
  double local_map_ms = 0.0;          ///< mean per local map of a run, median of the runs
  double local_map_max_ms = 0.0;      ///< maximum of a run, median of the runs
  double local_map_kbytes = 0.0;      ///< serialized
};

/// A program that evaluates one stage on all recordings and prints two tables in Markdown: errors
/// by hand-verified relations, and errors by a reference path. Each row begins with the columns log
/// and odometry; the headings and functions are those of the columns behind them.
struct AccuracyTables {
  const char* program;
  const char* description;
  int default_runs;  ///< of each log
  std::string relations_heading;
  std::function<std::string(const Benchmark&, const std::vector<Relation>&, const Evaluation&)>
      relations_row;
  std::string path_heading;
  std::function<std::string(const Evaluation&, const Trajectory& reference)> path_row;
};

/// The main function of the program; its option `--runs` sets the number of runs of each log.
/// Recordings that are not installed are skipped. Returns the exit status.
int print_accuracy_tables(int argc, char** argv, const AccuracyTables& tables);

}  // namespace adit
