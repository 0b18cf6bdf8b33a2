// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/eval/mapping/evaluation.hpp"
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
