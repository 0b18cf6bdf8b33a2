// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "procs/mapping/map_gaps.hpp"
#include "tools/log_times/time_choice.hpp"
#include "tools/map/doubt_list.hpp"
#include "tools/map/full_map.hpp"
#include "tools/map/run_record.hpp"
#include "tools/map/time_statistics.hpp"

namespace adit {

/// Time and memory of a run.
struct RunCost {
  double wall_s = 0.0;          ///< of the complete run, including files
  double cpu_s = 0.0;           ///< user and system, of the process since its start
  double peak_memory_mb = 0.0;  ///< resident
  TimeStatistics scans;         ///< wall time of scan matching per scan
  TimeStatistics local_maps;    ///< wall time of mapping per local map
};

/// CPU time and peak memory of this process; the other members are not set.
RunCost process_cost();

/// What is wrong with the map that was resumed.
struct ResumedMap {
  std::string report;  ///< damage of its journal, in a line; empty if it is intact or there is none
  MapLosses losses;
};

/// Figures of a run as JSON, for summary.json: scans by status, the times that were used, path
/// length, computation times, memory, the map including earlier sessions, the stretches of this run
/// on which the map may be wrong, and the segments where motion was not fully observed
/// (SegmentList). Its size does not grow with the log: a list has a few hundred entries at most.
std::string summary_json(const RunRecord& record, const EarlierMap& earlier, const FullMap& map,
                         const std::vector<DoubtfulStretch>& stretches, const TimeChoice& times,
                         const ResumedMap& resumed, const RunCost& cost);

/// Loop closures of a map.
struct LoopClosureCounts {
  std::size_t proposed = 0;
  std::size_t accepted = 0;  ///< at the end
  std::size_t revised = 0;   ///< decisions that replaced an earlier one
};

LoopClosureCounts count_loop_closures(const FullMap& map);

}  // namespace adit
