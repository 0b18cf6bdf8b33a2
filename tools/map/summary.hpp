// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "tools/map/run_record.hpp"

namespace adit {

/// What a run cost, on this machine.
struct RunCost {
  double wall_s = 0.0;          ///< of the whole run, files included
  double cpu_s = 0.0;           ///< user and system, of the process since its start
  double peak_memory_mb = 0.0;  ///< resident
  std::vector<double> scan_ms;  ///< wall time of each scan
};

/// CPU time and peak memory of this process so far; the rest is the caller's.
RunCost cost_so_far();

/// The figures of a run as JSON, for summary.json: scans and their fate, path length, times,
/// real-time factor, memory, and every stretch where motion was not fully observed.
std::string summary_json(const RunRecord& record, const RunCost& cost);

}  // namespace adit
