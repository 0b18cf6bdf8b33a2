// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "common/pose_graph/map_graph.hpp"
#include "common/records/time_budget.hpp"
#include "common/types/exploration.hpp"
#include "common/types/mission.hpp"
#include "tools/eval/trajectory.hpp"

namespace adit::test {

/// The contents of the log of a simulated mission.
struct MissionLog {
  Trajectory truth;                       ///< T_world_body
  std::vector<Eigen::Isometry3d> bodies;  ///< the same in space, T_world_body
  Trajectory estimated;                   ///< T_map_body, as estimated at the time
  Trajectory mapped;  ///< T_map_body by the last graph, from the first local map on
  MapGraph graph;     ///< the last one
  std::map<int, std::int64_t> local_map_utimes;  ///< begin of each local map
  std::set<std::array<int, 2>> loop_closures;    ///< pairs of local maps that were ever linked
  std::vector<MissionPhase> phases;              ///< each change once
  std::vector<BlockedVerdict> verdicts;          ///< each once
  std::optional<ExplorationReport> report;       ///< the last
  TimeBudget budget;
  int guard_stops = 0;                ///< while a path was driven
  double distance_travelled_m = 0.0;  ///< true
  std::string failure;                ///< why the run failed; empty if it did not
};

/// Reads a log; poses are sampled at 10 Hz. Throws std::runtime_error if the file is not an LCM
/// log.
MissionLog read_mission(const std::filesystem::path& log);

}  // namespace adit::test
