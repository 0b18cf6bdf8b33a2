// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>

#include "procs/mapping/mapping.hpp"
#include "tools/eval/trajectory.hpp"

namespace adit {

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

/// Runs scan matching and mapping `runs` times on a log, with a temporary output folder. Throws
/// std::runtime_error if two runs give different trajectories.
Evaluation evaluate(const std::filesystem::path& log, bool use_odometry, int runs);

}  // namespace adit
