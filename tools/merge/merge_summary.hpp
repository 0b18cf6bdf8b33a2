// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "common/pose_graph/certified_optimum.hpp"
#include "tools/merge/map_changes.hpp"
#include "tools/merge/merge_files.hpp"
#include "tools/merge/run_groups.hpp"

namespace adit {

/// What summary.json tells about a merge.
struct MergeSummary {
  std::vector<RunInfo> runs;
  std::vector<std::vector<std::string>> warnings;  ///< of each run
  const RunGroups* groups = nullptr;
  std::vector<MapChange> changes;
  Certificate optimum;
  std::size_t constraints = 0;  ///< of the graph
  bool has_journal = false;
  double wall_s = 0.0;
};

/// summary.json: runs with the map that each is in, every join with its links, every rejection with
/// its reason, changes, the optimum, and the cost.
std::string merge_summary_json(const MergeSummary& summary);

}  // namespace adit
