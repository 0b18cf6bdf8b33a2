// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "common/geometry/pose2.hpp"
#include "common/pose_graph/map_graph.hpp"
#include "common/types/association.hpp"
#include "common/types/local_map.hpp"
#include "procs/mapping/mapping.hpp"
#include "tools/eval/trajectory.hpp"
#include "tools/map/run_record.hpp"

namespace adit {

/// A scan and where the map has it.
struct PlacedScan {
  const std::string* channel = nullptr;
  const LaserScan* scan = nullptr;
  Pose2 T_map_body;
};

/// The map as a run leaves it, with what earlier runs knew. It refers to both, which must outlive
/// it.
struct FullMap {
  std::vector<const LocalMap*> local_maps;  ///< by id
  std::vector<const Association*> associations;
  MapGraph graph;  ///< empty where there is no local map

  /// T_map_body, a session each: of earlier ones at the scans that were kept, of this one at all.
  std::vector<Trajectory> paths;
  /// For the grid: those of the local maps and those after the last one.
  std::vector<PlacedScan> scans;
};

FullMap full_map(const StoredMap& earlier, const RunRecord& record);

/// All paths as one, in order of time. Of two poses at one time, that of the later session.
Trajectory joined_path(const FullMap& map);

/// How many closures in force hold the last session to earlier ones.
std::size_t count_cross_session_loop_closures(const FullMap& map);

}  // namespace adit
