// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>

#include "procs/mapping/mapping.hpp"
#include "tools/eval/trajectory.hpp"

namespace adit {

/// What `adit map` made of a log, over several runs.
struct Evaluation {
  Trajectory odometry;    ///< T_odom_body: of scan matching
  Trajectory trajectory;  ///< T_map_body: of mapping
  StoredMap map;
  std::size_t scans = 0;
  std::size_t lost_scans = 0;
  std::size_t searched = 0;
  std::size_t degenerate = 0;  ///< scans that left a direction open
  std::size_t degenerate_stretches = 0;
  double degenerate_m = 0.0;           ///< length of these stretches together
  double scan_ms = 0.0;                ///< mean of a run, median of the runs
  double scan_p99_ms = 0.0;            ///< 99th percentile of a run, median of the runs
  std::size_t loop_closures = 0;       ///< in force at the end
  std::size_t replaced_decisions = 0;  ///< decisions that were replaced
  double local_map_ms = 0.0;           ///< mapping, mean of a run, median of the runs
  double local_map_max_ms = 0.0;       ///< the longest of a run, median of the runs
  double local_map_kbytes = 0.0;       ///< serialised
};

/// Runs the pipeline `runs` times on a log, in a folder that is gone afterwards. Throws
/// std::runtime_error where the runs do not all give the same trajectory.
Evaluation evaluate(const std::filesystem::path& log, bool use_odometry, int runs);

}  // namespace adit
