// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "tools/map/full_map.hpp"
#include "tools/map/run_record.hpp"

namespace adit {

/// What a run cost, on this machine.
struct RunCost {
  double wall_s = 0.0;               ///< of the whole run, files included
  double cpu_s = 0.0;                ///< user and system, of the process since its start
  double peak_memory_mb = 0.0;       ///< resident
  std::vector<double> scan_ms;       ///< wall time of scan matching, of each scan
  std::vector<double> local_map_ms;  ///< wall time of mapping, of each local map
};

/// CPU time and peak memory of this process so far; the rest is the caller's.
RunCost process_cost();

/// The figures of a run as JSON, for summary.json: scans and their fate, path length, times,
/// real-time factor, memory, the map with what earlier runs left in it, and every stretch of this
/// run where motion was not fully observed.
std::string summary_json(const RunRecord& record, const FullMap& map, const RunCost& cost);

/// Of the closures of a map.
struct LoopClosureCounts {
  std::size_t proposed = 0;
  std::size_t in_force = 0;  ///< at the end
  std::size_t revised = 0;   ///< decisions that replaced an earlier one
};

LoopClosureCounts count_loop_closures(const FullMap& map);

}  // namespace adit
